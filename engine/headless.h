#pragma once
// OpenGL without a window and without X, for captures and tests.

#include <string>

namespace engine {

/// An OpenGL 3.3 core context made current on the calling thread: Mesa's surfaceless platform, else an EGL device
/// (NVIDIA). It has no framebuffer of its own: draw into an engine::Framebuffer.
class HeadlessContext {
 public:
  /// Throws Unavailable if neither gives OpenGL 3.3.
  HeadlessContext();
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

 private:
  bool open(void* display, std::string& problem);

  void* display_ = nullptr;  // EGLDisplay and EGLContext: EGL's headers drag X11's macros in
  void* context_ = nullptr;
};

}  // namespace engine
