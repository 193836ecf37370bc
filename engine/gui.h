#pragma once
// Dear ImGui with the program's theme and font, in a window or headless. Between begin_frame() and end_frame(), call
// ImGui itself.

#include <array>
#include <filesystem>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "engine/key_reader.h"

namespace engine {

class Window;

/// What a headless frame is fed with: pixels from the top left corner.
struct GuiInput {
  glm::ivec2 display_size{1280, 800};
  glm::vec2 mouse{-1.0f};
  std::array<bool, 3> buttons{};  // left, right, middle
  float wheel = 0.0f;             // steps since the last frame
  float seconds = 1.0f / 60.0f;   // since the last frame, > 0
};

class Gui {
 public:
  /// For a window, with its mouse and keyboard. `settings` is where ImGui keeps its windows' places; empty: nowhere.
  explicit Gui(Window& window, const std::filesystem::path& settings = {});
  /// Headless: drawn into whatever framebuffer is bound, by the input that the caller feeds.
  explicit Gui(float scale = 1.0f);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  void begin_frame();                       // window, whose input it takes
  void begin_frame(const GuiInput& input);  // headless
  void end_frame();
  /// The last frame that was ended, into the bound framebuffer; as often as wanted, until the next one begins.
  void draw() const;

  bool wants_mouse() const;     // the mouse is over a panel, or holds one of its widgets
  bool wants_keyboard() const;  // a text field has the focus
  /// What the window's frames since the last call were told of keys, less what was typed into text fields.
  std::vector<KeyPress> take_key_presses();

  /// ImGui units per pixel of the design: multiply every fixed width by it.
  float scale() const { return scale_; }

 private:
  static constexpr double never = -1e9;

  void create(const std::filesystem::path& settings);
  void take_input();
  void apply_scale(float content_scale, float pixel_ratio);

  Window* window_ = nullptr;
  std::string settings_;  // ImGui keeps a pointer to it
  KeyReader key_reader_;
  std::vector<KeyPress> key_presses_;
  std::array<bool, 3> buttons_{};
  std::array<double, 3> pressed_{never, never, never};  // s: when each button went down last
  float content_scale_ = 0.0f, pixel_ratio_ = 0.0f, scale_ = 1.0f;
};

}  // namespace engine
