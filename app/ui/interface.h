#pragma once
// All that is drawn with Dear ImGui over and beside the scene, put together; no window needed.

#include "app/ui/hash_view.h"
#include "app/ui/layout.h"
#include "app/ui/sweep_view.h"

namespace app {

class Interface {
 public:
  /// One frame, between begin_frame() and end_frame() of the Gui. `seconds`: since the window opened.
  void draw(Session& session, UiState& ui, float scale, double seconds, Recorder* recorder = nullptr);

  /// Where the scene shows since the last draw(), in ImGui units. All else, unless it is over the scene, has no ground:
  /// clear the frame to dock_colour().
  const SceneArea& scene_area() const { return layout_.scene; }
  const HashView& hash_view() const { return hash_view_; }
  const SweepView& sweep_view() const { return sweep_view_; }

 private:
  void draw_over_scene(Widgets& widgets, Session& session, UiState& ui, double seconds);

  Layout layout_;
  HashView hash_view_;
  SweepView sweep_view_;
  Hover hover_;
};

}  // namespace app
