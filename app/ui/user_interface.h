#pragma once
// All that Dear ImGui draws over and beside the scene. It needs no window.

#include "app/ui/layout.h"
#include "app/ui/strip.h"
#include "app/ui/views/sweep_view.h"

namespace app::ui {

class UserInterface {
 public:
  /// Draws one frame, and returns what the user asks for by it: see carry_out(). Call it between begin_frame() and
  /// end_frame() of the Gui.
  Requests draw(const Session& session, const UiState& ui, float scale, WidgetRecorder* recorder = nullptr);

  /// The area of the scene in the last draw(), in ImGui units. Docked windows draw no background: clear the frame to
  /// dock_colour() before.
  const ScreenRect& scene_area() const { return layout_.scene; }
  const SweepView& sweep_view() const { return sweep_view_; }

 private:
  /// Says what is wrong with what was typed into a field of numbers, until the field is right.
  void show_field_problem(Widgets& widgets);

  Layout layout_;
  SweepView sweep_view_;
  Strip strip_;
  float beside_height_ = 0;
  InputState input_;
  std::string field_problem_;  // said last
};

}  // namespace app::ui
