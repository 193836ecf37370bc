#include <cmath>

#include "app/base/text.h"
#include "app/report/integrator_colours.h"
#include "app/report/stability/results.h"

namespace app {

std::vector<Plot> stability_plots(const StabilityResults& results) {
  if (results.steps.empty()) return {};
  std::string script =
      joined(plot_style, "set title 'Largest stable step against stiffness'\nset xlabel 'stiffness of a spring, N/m'\n",
             format("set ylabel 'step, s'\nset yrange [*:%g]\nset format xy '%%g'\n", 2 * longest_step_tried));
  std::string plot;
  for (std::size_t i = 0; i < results.steps.size(); ++i) {
    std::string found, predicted;
    for (const StableStep& s : results.steps[i]) {
      found += format("%g %.9g\n", s.stiffness, s.found);
      if (std::isfinite(s.predicted)) predicted += format("%g %.9g\n", s.stiffness, s.predicted);
    }
    const char* colour = integrator_colour(i);
    script += joined(format("$f%zu << EOD\n", i), found, "EOD\n");
    plot += joined(plot.empty() ? "plot " : ", ",
                   format("$f%zu with linespoints pointtype 7 linewidth 2 linecolor rgb '%s' title ", i, colour),
                   literal(results.integrators[i]->name));
    if (predicted.empty()) continue;
    script += joined(format("$p%zu << EOD\n", i), predicted, "EOD\n");
    plot += format(", $p%zu with lines dashtype 2 linewidth 1.5 linecolor rgb '%s' notitle", i, colour);
  }
  return {{std::string(stable_step_plot),
           format("The largest step that keeps the energy of a disturbed ball (tried up to %g s); dashed: the bound "
                  "that the solver trusts, safety included.",
                  longest_step_tried),
           joined(script, plot, "\n")}};
}

}  // namespace app
