#include "engine/context.h"

#include <GL/glew.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace engine {
namespace {

bool is_opengl_es() {
  return std::string_view(reinterpret_cast<const char*>(glGetString(GL_VERSION))).starts_with("OpenGL ES");
}

}  // namespace

void load_opengl() {
  glewExperimental = GL_TRUE;
  const GLenum status = glewInit();
  // Debian's GLEW also looks for GLX. Without X it reports this error after it has loaded everything that is needed.
  if (status != GLEW_OK && status != GLEW_ERROR_NO_GLX_DISPLAY) {
    throw ContextError(std::string("cannot load OpenGL: ") + reinterpret_cast<const char*>(glewGetErrorString(status)) +
                       "; check the graphics driver, or use 'simulate', which needs none");
  }
  glGetError();  // in core contexts, glewInit leaves an error behind
  GLint major = 0, minor = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  const bool es = is_opengl_es();
  if (major * 10 + minor < (es ? 30 : 33)) {
    throw ContextError(std::string("the graphics driver offers OpenGL ") + (es ? "ES " : "") + std::to_string(major) +
                       "." + std::to_string(minor) + ", but " + (es ? "3.0" : "3.3") +
                       " is needed: update it, or set LIBGL_ALWAYS_SOFTWARE=1");
  }
}

const char* glsl_version() { return is_opengl_es() ? "#version 300 es" : "#version 330 core"; }

bool uses_software_renderer() {
  const std::string_view name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  constexpr std::array renderers{"llvmpipe", "softpipe", "SwiftShader"};
  return std::ranges::any_of(renderers, [name](const char* renderer) { return name.find(renderer) != name.npos; });
}

}  // namespace engine
