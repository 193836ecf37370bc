#pragma once
// A window with an OpenGL 3.3 core context, its mouse and keyboard and the files dropped on it. One window per program.

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "engine/input_queue.h"

struct GLFWwindow;

namespace engine {

struct WindowOptions {
  std::string title = "sbcollide";
  glm::ivec2 size{1280, 800};  // screen coordinates; cut down to the monitor's work area
  int samples = 4;             // multisampling of the window's own framebuffer; 0 for none
  bool vsync = true;
  bool visible = true;
};

class Window {
 public:
  /// Makes its context current. Throws Unavailable without a display or without OpenGL 3.3.
  explicit Window(const WindowOptions& options = {});
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  bool open() const;  // until the user or close() closes it
  void close();

  /// Handles what happened since the last call, and waits up to so many seconds for something to happen; up to 0.1 s
  /// while minimised, so that a loop does not spin.
  void poll(double seconds = 0);
  /// Of what happened in all calls of poll() until now, what the next frame may be told.
  std::vector<InputEvent> take_input() { return input_.take(); }
  bool input_waits() const { return !input_.empty(); }  // for another frame
  // What happened in all calls of poll() since it was last taken.
  std::vector<std::string> take_dropped_files();  // paths
  /// Shows the frame; with vsync, waits for the monitor.
  void present();
  void set_vsync(bool on);
  void set_title(const std::string& title);
  /// The driver was reset: nothing that was made in this window's context is left. Known only of drivers that tell.
  bool context_lost() const;
  /// After such a loss: until the reset is over, for a few seconds at most, so that another window can be made.
  void wait_for_reset() const;

  // As they were when poll() returned last.
  bool minimised() const { return minimised_; }  // nothing to draw: framebuffer_size() may be 0 x 0
  glm::ivec2 framebuffer_size() const { return framebuffer_size_; }
  /// Framebuffer pixels per screen coordinate; not the same as content_scale() on X11.
  float pixel_ratio() const { return pixel_ratio_; }

  float content_scale() const;  // 1 on an ordinary screen, 2 on a high-density one
  glm::vec2 cursor() const;     // framebuffer pixels from the top left corner
  bool left_button_down() const;

  GLFWwindow* handle() const { return window_; }

 private:
  void measure();

  static void on_key(GLFWwindow* window, int key, int scancode, int action, int mods);
  static void on_character(GLFWwindow* window, unsigned int code);
  static void on_cursor(GLFWwindow* window, double x, double y);
  static void on_scroll(GLFWwindow* window, double x, double y);
  static void on_drop(GLFWwindow* window, int count, const char** paths);
  static void on_button(GLFWwindow* window, int button, int action, int mods);

  GLFWwindow* window_ = nullptr;
  // Kept, as X11 must be asked for each, and waited for: a dozen times a frame that would be.
  glm::ivec2 framebuffer_size_{0};
  float pixel_ratio_ = 1.0f;
  bool minimised_ = false;
  InputQueue input_;
  glm::vec2 cursor_{0.0f};  // screen coordinates, as the events tell: while they are handled, it is further already
  double polled_ = 0;       // s: what is not handled yet happened since
  std::vector<std::string> dropped_files_;
};

}  // namespace engine
