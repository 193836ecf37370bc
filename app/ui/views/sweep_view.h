#pragma once
// The window "Error against run time": a sweep of the shown methods over their settings on one frozen frame, with its
// progress.

#include "app/session/session.h"
#include "app/ui/views/status.h"
#include "app/ui/views/sweep_plot.h"

namespace app::ui {

class SweepView {
 public:
  /// Returns the height in design pixels for so many methods in a window of this height.
  static float preferred_height(std::size_t methods, float window);
  static constexpr float min_height = 250;

  /// Draws the plot over `area`. A sweep runs on while the plot is closed. A click on a point asks for its method and
  /// settings.
  void draw(Widgets& widgets, const Session& session, const ScreenRect& area);

  /// For tests.
  const SweepPlot& plot() const { return plot_; }

 private:
  void draw_plot(Widgets& widgets, const Session& session, float height, std::optional<std::size_t> method);

  SweepPlot plot_;
};

}  // namespace app::ui
