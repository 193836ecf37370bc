#pragma once
// All that is drawn with Dear ImGui over and beside the scene, put together; no window needed.

#include "app/demo/session.h"
#include "app/demo/ui_state.h"
#include "app/panel/sweep_view.h"
#include "app/panel/widgets.h"
#include "app/view/hash_view.h"

namespace app {

class Interface {
 public:
  static constexpr float least_scene_width = 240;  // design pixels

  /// Where the scene shows, in ImGui units: beside the panel, or behind it where the window is too narrow for both; and
  /// beside or above the card of the tour.
  static SceneArea scene_area(const UiState& ui, float scale);

  /// One frame, between begin_frame() and end_frame() of the Gui. `seconds`: since the window opened.
  void draw(Session& session, UiState& ui, float scale, double seconds, Recorder* recorder = nullptr);

  const HashView& hash_view() const { return hash_view_; }
  const SweepView& sweep_view() const { return sweep_view_; }

 private:
  static constexpr float least_height_for_table = 400, margin = 12;  // design pixels; margin: beside the table
  static constexpr float card_width = 340;                           // of the tour

  static bool panel_covers_scene(const UiState& ui, float scale);
  static bool shows_panel(const UiState& ui, float scale);
  static SceneArea beside_panel(const UiState& ui, float scale);
  static SceneArea tour_area(const UiState& ui, float scale);
  void draw_over_scene(Widgets& widgets, Session& session, UiState& ui, const SceneArea& area, double seconds);

  HashView hash_view_;
  SweepView sweep_view_;
  Hover hover_;
};

}  // namespace app
