#pragma once
// A window with an OpenGL 3.3 core context, its mouse and keyboard, and files dropped on it.

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "engine/input_queue.h"

struct GLFWwindow;

namespace engine {

/// Only one window can exist at a time.
class Window {
 public:
  /// Makes its context current. size: > 0, screen coordinates; it is reduced to the monitor's work area. Throws
  /// ContextError if there is no display or no OpenGL 3.3.
  Window(const std::string& title, glm::ivec2 size);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  bool is_open() const;  // until the user closes it

  /// Handles the events since the last call and waits up to `seconds` for one. While the window is minimised, it waits
  /// up to 0.25 s instead, so that a loop does not spin. Returns true if there were any: the window may need another
  /// frame.
  bool poll(double seconds = 0);
  // Events of all calls of poll() are kept until they are taken.
  std::vector<InputEvent> take_input() { return input_.take(); }  // of the next frame; see InputQueue::take()
  bool has_pending_input() const { return !input_.empty(); }      // for a further frame
  std::vector<std::string> take_dropped_files();                  // paths
  /// Shows the frame; waits for the monitor.
  void present();
  /// True after a driver reset: nothing that was made in this window's context is left. Not every driver reports a
  /// reset.
  bool context_lost() const;
  /// Waits until the reset is over, for 5 s at most. Then another window can be made.
  void wait_for_context_reset() const;

  // State after the last poll().
  /// True if nobody can see the window, minimised or unmapped: there is nothing to draw, framebuffer_size() may be
  /// 0 x 0.
  bool minimised() const { return minimised_; }
  glm::ivec2 framebuffer_size() const { return framebuffer_size_; }
  /// Framebuffer pixels per screen coordinate. On X11 it differs from content_scale().
  float pixel_ratio() const { return pixel_ratio_; }

  // Current state.
  float content_scale() const;  // 1 on an ordinary screen, 2 on a high-density one
  glm::vec2 cursor() const;     // framebuffer pixels from the top left corner
  bool left_button_down() const;

  GLFWwindow* handle() const { return window_; }

 private:
  void update_size();
  void set_callbacks();  // GLFW then fills the members below

  GLFWwindow* window_ = nullptr;
  // Stored, because each query waits for the X server and a frame asks a dozen times.
  glm::ivec2 framebuffer_size_{0};
  float pixel_ratio_ = 1.0f;
  bool minimised_ = false;
  bool event_ = false;  // since the last poll()
  InputQueue input_;
  glm::vec2 cursor_{0.0f};  // screen coordinates at the event being handled; cursor() is already further
  double last_poll_ = 0;    // s: pending events happened after it
  std::vector<std::string> dropped_files_;
};

}  // namespace engine
