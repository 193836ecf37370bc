#pragma once
// The window "Error against run time": a sweep of the shown methods over their settings on one frozen frame, with its
// progress.

#include "app/session/live/sweep_worker.h"
#include "app/session/session.h"
#include "app/ui/views/status.h"
#include "app/ui/views/sweep_plot.h"

namespace app::ui {

class SweepView {
 public:
  /// Returns the height in design pixels for so many methods in a window of this height.
  static float preferred_height(std::size_t methods, float window);
  static constexpr float min_height = 250;

  /// Takes the sweep's progress. To be called in each frame, also if something covers the window.
  void update();
  /// Draws the plot over `area`. Its close button sets `open` to false; a sweep runs on while the plot is closed. A
  /// click on a point gives its method and settings to the session.
  void draw(Widgets& widgets, Session& session, const ScreenRect& area, bool& open);

  // For tests.
  const SweepPlot& plot() const { return plot_; }
  const session::SweepState& state() const { return state_; }

 private:
  void draw_button(Widgets& widgets, const Session& session);
  void draw_controls(Widgets& widgets, Session& session);
  void draw_legend(Widgets& widgets, const compare::MethodSet& shown);
  void draw_plot(Widgets& widgets, Session& session, float height);

  session::SweepState state_;
  SweepPlot plot_;
  std::optional<std::size_t> hovered_method_;  // under the mouse in the legend
  session::SweepWorker worker_;
};

}  // namespace app::ui
