#include <cmath>

#include <fmt/core.h>

#include "app/report/integrator_colours.h"
#include "app/report/stability/results.h"

namespace app {

std::vector<Plot> stability_plots(const StabilityResults& results) {
  if (results.steps.empty()) return {};
  std::string script = fmt::format(
      "{}set title 'Largest stable step against stiffness'\nset xlabel 'stiffness of a spring, N/m'\nset ylabel 'step, "
      "s'\nset yrange [*:{:g}]\nset format xy '%g'\n",
      plot_style, 2 * longest_step_tried);
  std::string plot;
  for (std::size_t i = 0; i < results.steps.size(); ++i) {
    std::string found, predicted;
    for (const StableStep& s : results.steps[i]) {
      found += fmt::format("{:g} {:.9g}\n", s.stiffness, s.found);
      if (std::isfinite(s.predicted)) predicted += fmt::format("{:g} {:.9g}\n", s.stiffness, s.predicted);
    }
    const char* colour = integrator_colour(i);
    script += fmt::format("$f{} << EOD\n{}EOD\n", i, found);
    plot += fmt::format("{}$f{} with linespoints pointtype 7 linewidth 2 linecolor rgb '{}' title {}",
                        plot.empty() ? "plot " : ", ", i, colour, literal(results.integrators[i]->name));
    if (predicted.empty()) continue;
    script += fmt::format("$p{} << EOD\n{}EOD\n", i, predicted);
    plot += fmt::format(", $p{} with lines dashtype 2 linewidth 1.5 linecolor rgb '{}' notitle", i, colour);
  }
  return {{std::string(stable_step_plot),
           fmt::format("The largest step that keeps the energy of a disturbed ball (tried up to {:g} s); dashed: the "
                       "bound that the solver trusts, safety included.",
                       longest_step_tried),
           fmt::format("{}{}\n", script, plot)}};
}

}  // namespace app
