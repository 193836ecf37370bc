#include "engine/headless.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <cstring>
#include <vector>

#include "engine/context.h"

namespace engine {
namespace {

bool has_extension(const char* list, const char* name) { return list != nullptr && std::strstr(list, name) != nullptr; }

template <class Function>
Function egl_function(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

/// Returns the displays to try, best first.
std::vector<EGLDisplay> candidate_displays() {
  const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const auto get_display = egl_function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  std::vector<EGLDisplay> displays;
  if (get_display == nullptr) return displays;
  if (has_extension(client, "EGL_MESA_platform_surfaceless")) {
    displays.push_back(get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  }
  const auto query_devices = egl_function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  if (query_devices != nullptr && has_extension(client, "EGL_EXT_platform_device")) {
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count);
    for (int i = 0; i < count; ++i) {
      displays.push_back(get_display(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)], nullptr));
    }
  }
  return displays;
}

/// Returns an OpenGL 3.3 core context, or EGL_NO_CONTEXT.
EGLContext create_context(EGLDisplay display) {
  constexpr std::array<EGLint, 5> config_attributes{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
  constexpr std::array<EGLint, 7> context_attributes{
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint found = 0;
  if (!eglBindAPI(EGL_OPENGL_API)) return EGL_NO_CONTEXT;
  if (!eglChooseConfig(display, config_attributes.data(), &config, 1, &found) || found == 0) return EGL_NO_CONTEXT;
  return eglCreateContext(display, config, EGL_NO_CONTEXT, context_attributes.data());
}

}  // namespace

HeadlessContext::HeadlessContext() {
  std::string problem = "EGL knows no platform that works without a display";
  for (EGLDisplay display : candidate_displays()) {
    if (try_display(display, problem)) return;
  }
  throw ContextError("cannot draw without a window: " + problem +
                     "; install Mesa's drivers (packages libegl-mesa0 and libgl1-mesa-dri)");
}

/// Makes a context on `display` current. Returns false and sets `problem` if that fails.
bool HeadlessContext::try_display(void* display, std::string& problem) {
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) return false;
  const EGLContext context = create_context(display);
  if (context != EGL_NO_CONTEXT && eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
    try {
      load_opengl();
      display_ = display;
      context_ = context;
      return true;
    } catch (const ContextError& error) {
      problem = error.what();
    }
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  } else {
    problem = "the EGL driver gives no OpenGL 3.3 core context";
  }
  if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
  eglTerminate(display);
  return false;
}

HeadlessContext::~HeadlessContext() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
  // The display is not terminated: the whole process shares it, and another context may use it.
}

}  // namespace engine
