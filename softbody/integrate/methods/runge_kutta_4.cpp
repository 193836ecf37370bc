#include <array>

#include "softbody/integrate/dynamics.h"
#include "softbody/integrate/integrator_steps.h"

namespace softbody {
namespace {

constexpr Quantity start_x = scratch(0), start_v = scratch(1), mean_v = scratch(2), mean_a = scratch(3);

/// One of the four stages: takes its share of the means and goes on to where the next one stands, `ahead` seconds from
/// the start.
void stage(Dynamics& dynamics, Batch& batch, float weight, float ahead) {
  dynamics.accelerations(batch);
  dynamics.add(batch, mean_v, weight, velocities);
  dynamics.add(batch, mean_a, weight, forces);
  dynamics.copy(batch, start_x, positions);
  dynamics.add(batch, positions, ahead, velocities);
  dynamics.copy(batch, start_v, velocities);
  dynamics.add(batch, velocities, ahead, forces);
}

}  // namespace

void runge_kutta_4(Dynamics& dynamics, const Worker& worker, const Substep& substep) {
  constexpr std::array<float, 4> weight{1.0f / 6, 1.0f / 3, 1.0f / 3, 1.0f / 6}, ahead{0.5f, 0.5f, 1.0f, 0.0f};
  const float h = substep.h;
  for (Batch* batch : worker.batches()) {
    dynamics.copy(*batch, positions, start_x);
    dynamics.copy(*batch, velocities, start_v);
    dynamics.clear(*batch, mean_v);
    dynamics.clear(*batch, mean_a);
  }
  for (std::size_t s = 0; s < 4; ++s) {
    dynamics.contact_forces(worker, s == 0 ? h : 0);  // friction's springs slip once a step
    for (Batch* batch : worker.batches()) dynamics.all_forces(*batch);
    for (Batch* batch : worker.batches()) stage(dynamics, *batch, weight[s], ahead[s] * h);
    worker.barrier();
  }
  for (Batch* batch : worker.batches()) dynamics.copy(*batch, mean_v, velocities);
  dynamics.contacts(worker, h);
  for (Batch* batch : worker.batches()) {
    dynamics.drift(*batch, h);
    dynamics.add(*batch, velocities, -1, mean_v);  // what the contacts have changed
    dynamics.add(*batch, velocities, 1, start_v);
    dynamics.add(*batch, velocities, h, mean_a);
  }
  dynamics.contacts_at_end(worker, h);
  worker.barrier();
}

}  // namespace softbody
