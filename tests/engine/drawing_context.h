#pragma once
// The OpenGL contexts that the drawing must work in.

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <cstdlib>
#include <memory>

#include "engine/context.h"
#include "engine/headless.h"

namespace engine {

/// A current context of OpenGL ES 3.0, which is what a browser offers as WebGL 2. Mesa's platform without a display.
class EsContext {
 public:
  EsContext() {
    constexpr std::array<EGLint, 5> wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
    constexpr std::array<EGLint, 5> version{EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 0, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint found = 0;
    eglInitialize(display_, nullptr, nullptr);
    eglBindAPI(EGL_OPENGL_ES_API);
    eglChooseConfig(display_, wanted.data(), &config, 1, &found);
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, version.data());
    if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) throw ContextError("no OpenGL ES 3.0");
    load_opengl();
  }
  ~EsContext() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
  }
  EsContext(const EsContext&) = delete;
  EsContext& operator=(const EsContext&) = delete;

 private:
  EGLDisplay display_ = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  EGLContext context_ = EGL_NO_CONTEXT;
};

/// A current context: of OpenGL ES if the environment has TEST_OPENGL_ES, else of OpenGL.
class DrawingContext {
 public:
  DrawingContext() {
    if (std::getenv("TEST_OPENGL_ES"))
      es_ = std::make_unique<EsContext>();
    else
      core_ = std::make_unique<HeadlessContext>();
  }

 private:
  std::unique_ptr<EsContext> es_;
  std::unique_ptr<HeadlessContext> core_;
};

}  // namespace engine
