#include <cmath>

#include <fmt/ranges.h>

#include "app/report/stability/results.h"

namespace app {

Table stability_table(const StabilityResults& results) {
  Table table;
  for (const StabilitySection& section : results.sections)
    for (const StabilityRow& row : section.rows)
      for (const StabilityCell& cell : row.cells) {
        const StabilityFigures& f = cell.figures;
        const bool ran = f.refused.empty(), compared = f.reference.has_value();
        const AgainstReference end = f.reference.value_or(AgainstReference{});
        table.add({{"part", "cell"},
                   {"case", section.key},
                   {"integrator", results.integrators[cell.integrator]->key},
                   {"dt", results.dts[cell.dt]},
                   {"stiffness", row.stiffness},
                   {"passes", cell.passes()},
                   {"failures", fmt::format("{}", fmt::join(failures(f), "; "))},
                   {"not_judged", row.not_judged},
                   {"finite", when(ran, f.finite)},
                   {"energy_excess", when(ran, f.energy)},
                   {"speed_ratio", when(ran, f.speed)},
                   {"extent_ratio", when(ran, f.extent)},
                   {"transient_depth", when(ran, f.transient)},
                   {"steady_depth", when(ran, f.steady)},
                   {"through_solids", when(ran, f.through)},
                   {"shape", when(compared, end.shape)},
                   {"volume", when(compared, end.volume)},
                   {"rest", when(compared, end.rest)},
                   {"blew_up", when(ran && f.blew_up > 0, f.blew_up)},
                   {"stable_step", ""},
                   {"predicted_step", ""}});
      }
  for (std::size_t i = 0; i < results.steps.size(); ++i)
    for (const StableStep& step : results.steps[i])
      table.add({{"part", "step"},
                 {"integrator", results.integrators[i]->key},
                 {"stiffness", step.stiffness},
                 {"stable_step", step.found},
                 {"predicted_step", when(std::isfinite(step.predicted), step.predicted)}});
  return table;
}

}  // namespace app
