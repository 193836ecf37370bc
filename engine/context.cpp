#include "engine/context.h"

#include <GL/glew.h>

namespace engine {

void load_gl() {
  glewExperimental = GL_TRUE;
  const GLenum status = glewInit();
  // Debian's GLEW looks for GLX too. Without X it says so after it has loaded everything that matters.
  if (status != GLEW_OK && status != GLEW_ERROR_NO_GLX_DISPLAY) {
    throw Unavailable(std::string("cannot load OpenGL: ") + reinterpret_cast<const char*>(glewGetErrorString(status)) +
                      "; check the graphics driver, or use 'simulate', which needs none");
  }
  glGetError();  // glewInit leaves one behind in core contexts
  GLint major = 0, minor = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  if (major * 10 + minor < 33) {
    throw Unavailable("the graphics driver offers OpenGL " + std::to_string(major) + "." + std::to_string(minor) +
                      ", but 3.3 is needed: update it, or set LIBGL_ALWAYS_SOFTWARE=1");
  }
}

std::string gl_description() {
  const auto text = [](GLenum name) { return std::string(reinterpret_cast<const char*>(glGetString(name))); };
  return text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
}

bool draws_in_software() {
  const std::string driver = gl_description();
  return driver.find("llvmpipe") != driver.npos || driver.find("softpipe") != driver.npos;
}

}  // namespace engine
