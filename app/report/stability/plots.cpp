#include <cmath>

#include <fmt/core.h>

#include "app/report/stability/results.h"

namespace app {

Plot step_against_stiffness(const StabilityResults& results) {
  Plot plot{.name = "stability-steps",
            .caption = fmt::format("The largest step that keeps the energy of a disturbed ball (tried up to {:g} s); "
                                   "dashed: the bound that the solver relies on, with its safety factor.",
                                   max_step_tried),
            .title = "Largest stable step against stiffness",
            .x = "stiffness of a spring, N/m",
            .y = "step, s",
            .settings = fmt::format("set yrange [*:{:g}]\nset format xy '%g'\n", 2 * max_step_tried)};
  for (std::size_t i = 0; i < results.steps.size(); ++i) {
    Series found{std::string(results.integrators[i]->name), integrator_colour(i),
                 "linespoints pointtype 7 linewidth 2"};
    Series predicted{"", integrator_colour(i), "lines dashtype 2 linewidth 1.5"};
    for (const StableStep& s : results.steps[i]) {
      found.points.push_back({s.stiffness, s.found});
      if (std::isfinite(s.predicted)) predicted.points.push_back({s.stiffness, s.predicted});
    }
    plot.add(std::move(found));
    plot.add(std::move(predicted));
  }
  return plot;
}

}  // namespace app
