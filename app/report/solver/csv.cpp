#include "app/base/csv_line.h"
#include "app/report/solver/results.h"

namespace app {

std::string solver_csv(const SolverResults& results) {
  std::string text;
  {
    CsvLine line(text);
    for (const char* name :
         {"scene", "integrator", "substeps", "steps_per_second", "cpu_ms_alone", "cpu_ms_batch", "blew_up", "error",
          "energy_error", "linear_error", "angular_error", "volume_error", "internal_speed", "observed_order",
          "reference_step", "reference_change", "reference_converged", "perturbation_growth"})
      line.add(std::string_view(name));
  }
  for (const SolverCase& c : results.cases)
    for (const WorkCurve& curve : c.curves)
      for (const WorkPoint& p : curve.points) {
        CsvLine line(text);
        line.add(c.key);
        line.add(curve.integrator->key);
        line.add_if(p.substeps > 0, static_cast<std::uint64_t>(p.substeps));
        line.add_if(p.substeps > 0, p.substeps * curve.integrator->substeps / results.frame_time);
        line.add(p.cpu_alone);
        line.add_if(p.cpu_batch.has_value(), p.cpu_batch.value_or(0));
        line.add(static_cast<std::uint64_t>(p.blew_up));
        line.add_if(!p.blew_up, p.error);
        line.add_if(!p.blew_up, p.energy);
        for (const auto& value : {p.linear, p.angular, p.volume})
          line.add_if(!p.blew_up && value.has_value(), value.value_or(0));
        line.add_if(!p.blew_up, p.speed);
        const auto order = c.order(curve, results.bound);
        line.add_if(order.has_value(), order.value_or(0));
        line.add(c.step);
        line.add(c.change);
        line.add(static_cast<std::uint64_t>(c.converged));
        line.add(c.growth);
      }
  return text;
}

}  // namespace app
