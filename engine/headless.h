#pragma once
// An OpenGL context without a window and without an X server, for captures and tests.

#include <string>

namespace engine {

/// An OpenGL 3.3 core context, current on the calling thread: on Mesa's surfaceless platform, else on an EGL device
/// (NVIDIA). It has no framebuffer of its own: draw into an engine::Framebuffer.
class HeadlessContext {
 public:
  /// Throws ContextError if neither offers OpenGL 3.3.
  HeadlessContext();
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

 private:
  bool try_display(void* display, std::string& problem);

  // EGLDisplay and EGLContext, as void* because EGL's headers bring the macros of X11.
  void* display_ = nullptr;
  void* context_ = nullptr;
};

}  // namespace engine
