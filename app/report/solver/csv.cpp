#include "app/report/solver/results.h"

namespace app {

Table solver_table(const SolverResults& results) {
  Table table;
  for (const SolverCase& c : results.cases)
    for (const WorkCurve& curve : c.curves)
      for (const WorkPoint& p : curve.points) {
        const bool fixed = p.substeps > 0, good = !p.blew_up;
        table.add({{"scene", c.key},
                   {"integrator", curve.integrator->key},
                   {"substeps", when(fixed, p.substeps)},
                   {"steps_per_second", when(fixed, p.substeps * curve.integrator->substeps / results.frame_time)},
                   {"cpu_ms_alone", p.cpu_alone},
                   {"cpu_ms_batch", p.cpu_batch},
                   {"blew_up", p.blew_up},
                   {"error", when(good, p.error)},
                   {"energy_error", when(good, p.energy)},
                   {"linear_error", when(good, p.linear)},
                   {"angular_error", when(good, p.angular)},
                   {"volume_error", when(good, p.volume)},
                   {"internal_speed", when(good, p.speed)},
                   {"observed_order", c.order(curve, results.bound)},
                   {"reference_step", c.step},
                   {"reference_change", c.change},
                   {"reference_converged", c.converged},
                   {"perturbation_growth", c.growth}});
      }
  return table;
}

}  // namespace app
