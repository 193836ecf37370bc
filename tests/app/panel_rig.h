#pragma once
// The demo's whole user interface without a window: tests move a simulated mouse and look at the recorded widgets.

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <initializer_list>

#include "app/ui/user_interface.h"
#include "engine/gl.h"
#include "engine/gui.h"
#include "engine/headless.h"
#include "tests/app/scenes.h"

namespace app {

class PanelRig {
 public:
  /// scene_folder: where the panel finds other scenes and the presets.
  explicit PanelRig(float scale = 1, const files::Opened& opened = touching_pair(),
                    const std::filesystem::path& scene_folder = {})
      : gui_(scale), scale_(scale), session(opened, scene_folder, 1) {
    input_.display_size = {static_cast<int>(1280 * scale), static_cast<int>(1150 * scale)};
    ImGui::GetIO().MouseDoubleClickTime = 0;  // two fast clicks of a test are no double-click
    frames(3);                                // ImGui sizes its windows in the first frames
  }

  /// Runs one frame of the demo's loop, a 60th of a second.
  void frame() {
    session.advance(tick);
    target_.bind();
    gui_.begin_frame(input_);
    session.import.update();
    carry_out({});
    carry_out(interface.draw(session, ui, gui_.scale(), &recorder));
    gui_.end_frame();
    gui_.draw();
    ASSERT_EQ(collide::problem(session.world().collision()), "");
  }
  void frames(int count) {
    for (int i = 0; i < count; ++i) frame();
  }
  /// Runs frames until the condition is true. Returns false if it stays false for two minutes.
  template <class Condition>
  bool frames_until(const Condition& condition) {
    using Clock = std::chrono::steady_clock;
    for (const auto end = Clock::now() + std::chrono::minutes(2); Clock::now() < end;) {
      frame();
      if (condition()) return true;
    }
    return false;
  }

  void resize(int width, int height) {
    input_.display_size = {width, height};
    frames(3);
  }
  void press_escape() {
#if IMGUI_VERSION_NUM >= 18700
    const auto escape = [](bool down) { ImGui::GetIO().AddKeyEvent(ImGuiKey_Escape, down); };
#else
    ImGui::GetIO().KeyMap[ImGuiKey_Escape] = 1;
    const auto escape = [](bool down) { ImGui::GetIO().KeysDown[1] = down; };
#endif
    escape(true);
    frames(2);
    escape(false);
    frames(2);
  }

  void move(float x, float y) {
    input_.mouse = {x, y};
    frames(2);
  }
  void press() {
    input_.buttons[0] = true;
    frames(2);
  }
  void release() {
    input_.buttons[0] = false;
    frames(2);
  }
  void click_at(float x, float y) {
    move(x, y);
    press();
    release();
  }

  bool shows(std::string_view label) const { return recorder.find(label) != nullptr; }
  ui::WidgetRecorder::Widget widget(std::string_view label) const {
    const ui::WidgetRecorder::Widget* found = recorder.find(label);
    if (!found) ADD_FAILURE() << "no widget '" << label << "'";
    return found ? *found : ui::WidgetRecorder::Widget{};
  }
  /// Expects that each widget recorded before is where it was; `except`: the label of one that may move.
  void expect_in_place(const std::vector<ui::WidgetRecorder::Widget>& before, std::string_view except = "") const {
    for (const ui::WidgetRecorder::Widget& was : before) {
      const ui::WidgetRecorder::Widget is = widget(was.label);
      if (was.label == except) continue;
      EXPECT_TRUE(is.min.x == was.min.x && is.min.y == was.min.y && is.max.x == was.max.x && is.max.y == was.max.y)
          << was.label << " moved";
    }
  }
  ui::ScreenRect area(std::string_view label) const { return {widget(label).min, widget(label).max}; }
  /// Returns the middle of a widget.
  ImVec2 middle(std::string_view label) const {
    const auto [name, min, max, enabled] = widget(label);
    return {0.5f * (min.x + max.x), 0.5f * (min.y + max.y)};
  }
  /// Rests the mouse on a widget until its tooltip is there.
  void hover(std::string_view label) {
    const ImVec2 at = middle(label);
    move(at.x, at.y);
    frames(40);
  }
  void click(std::string_view label) {
    const ImVec2 at = middle(label);
    click_at(at.x, at.y);
  }
  /// Opens a section of the panel.
  void open(const char* section) {
    ui.open_section(section);
    frames(2);
  }
  void click_each(std::initializer_list<std::string_view> labels) {
    for (const std::string_view label : labels) click(label);
  }
  /// Changes the scene in use, as the panel's widgets do.
  void change(const std::function<void(softbody::Scene&)>& change) { session.simulation.change_scene("Test", change); }
  void double_click(std::string_view label) {
    click(label);
    ImGui::GetIO().MouseDoubleClickTime = 1;
    click(label);
    ImGui::GetIO().MouseDoubleClickTime = 0;
  }
  /// Clicks into a field, which selects all that is in it, and types.
  void type(std::string_view label, std::string_view text) {
    click(label);
    type(text);
  }
  /// Types into the field that is active.
  void type(std::string_view text) {
    for (const char c : text) ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(c));
    frames(static_cast<int>(text.size()) + 2);  // newer versions of ImGui take one key a frame
  }
  /// Presses in the middle of a slider and drags it sideways.
  void drag(std::string_view label, float by) {
    const auto [x, y] = middle(label);
    move(x, y);
    press();
    move(x + 0.3f * by * scale_, y);
    move(x + by * scale_, y);
    release();
  }

 private:
  void carry_out(const ui::Requests& requests) {
    for (const ui::WindowTask task : ui::carry_out(requests, session, ui)) tasks.push_back(task);
  }

  engine::HeadlessContext context_;  // first: the others need it
  engine::Framebuffer target_{{64, 64}, 0};
  engine::Gui gui_;
  engine::GuiInput input_;
  float scale_;

 public:
  Session session;
  ui::UiState ui;
  ui::UserInterface interface;
  ui::WidgetRecorder recorder;
  std::vector<ui::WindowTask> tasks{};  // that were left to the window
};

}  // namespace app
