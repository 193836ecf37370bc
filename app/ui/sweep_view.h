#pragma once
// The window "Error against run time": a sweep of every method over its settings on one frozen frame, as it goes on.

#include "app/session/session.h"
#include "app/session/sweep_worker.h"
#include "app/ui/status.h"
#include "app/ui/sweep_plot.h"

namespace app {

class SweepView {
 public:
  static constexpr float least_height = 364;  // of the area, in design pixels

  /// Draws the window in the lower left corner of the area; `open` becomes false when it is closed. A click on a point
  /// makes its method and settings those of the session. A sweep goes on while the window is closed.
  void draw(Widgets& widgets, Session& session, const SceneArea& area, bool& open);

  /// Tests aim by it, and wait for it.
  const SweepPlot& plot() const { return plot_; }
  const SweepState& state() const { return state_; }

 private:
  void draw_button(Widgets& widgets, const Session& session);
  void draw_controls(Widgets& widgets, const Session& session);
  void draw_legend(Widgets& widgets);
  void draw_plot(Widgets& widgets, Session& session, float height);
  void draw_footing(Widgets& widgets) const;

  SweepState state_;
  SweepPlot plot_;
  std::optional<std::size_t> looked_at_;  // the method under the mouse in the legend
  SweepWorker worker_;
};

}  // namespace app
