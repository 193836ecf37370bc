#pragma once
// Dear ImGui with the program's theme and font, in a window or headless. Call ImGui itself between begin_frame() and
// end_frame(). One Gui at a time.

#include <array>
#include <glm/vec2.hpp>
#include <vector>

#include "engine/key_translator.h"

namespace engine {

class Window;

/// Input of one headless frame. Positions are pixels from the top left corner.
struct GuiInput {
  glm::ivec2 display_size{1280, 800};
  glm::vec2 mouse{-1.0f};
  std::array<bool, 3> buttons{};  // left, right, middle
  float wheel = 0.0f;             // steps since the last frame
  float seconds = 1.0f / 60.0f;   // since the last frame, > 0
};

class Gui {
 public:
  /// For `window`, which must outlive the Gui.
  explicit Gui(Window& window);
  /// Headless: draws into the bound framebuffer. Needs a current context, also when destroyed. `scale` > 0.
  explicit Gui(float scale = 1.0f);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  void begin_frame();                       // in a window: takes the window's input
  void begin_frame(const GuiInput& input);  // headless
  void end_frame();
  /// Draws the last ended frame into the bound framebuffer. Can be repeated until the next frame begins.
  void draw() const;

  bool wants_mouse() const;     // the mouse is over a panel or holds a widget
  bool wants_keyboard() const;  // a text field has the focus
  /// Returns the key presses of the window's frames since the last call, without those that went into text fields.
  std::vector<KeyPress> take_key_presses();

  /// Factor for every width and height that is given to ImGui.
  float scale() const { return scale_; }

 private:
  static constexpr double never = -1e9;

  void take_input();
  void apply_scale(float content_scale, float pixel_ratio);

  Window* window_ = nullptr;
  KeyTranslator key_translator_;
  std::vector<KeyPress> key_presses_;
  std::array<bool, 3> buttons_{};
  std::array<double, 3> last_press_{never, never, never};  // s, of each button
  float content_scale_ = 0.0f, pixel_ratio_ = 0.0f, scale_ = 1.0f;
};

}  // namespace engine
