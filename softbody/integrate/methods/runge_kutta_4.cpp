#include <array>

#include "softbody/integrate/integrator_steps.h"
#include "softbody/integrate/motion.h"

namespace softbody {
namespace {

constexpr Quantity start_x = scratch(0), start_v = scratch(1), mean_v = scratch(2), mean_a = scratch(3);

/// One of the four stages: takes its share of the means and goes on to where the next one stands, `ahead` seconds from
/// the start.
void stage(Motion& motion, const Batch& batch, float weight, float ahead) {
  motion.accelerations(batch);
  motion.add(batch, mean_v, weight, velocities);
  motion.add(batch, mean_a, weight, forces);
  motion.copy(batch, start_x, positions);
  motion.add(batch, positions, ahead, velocities);
  motion.copy(batch, start_v, velocities);
  motion.add(batch, velocities, ahead, forces);
}

}  // namespace

void runge_kutta_4(Motion& motion, const BatchShare& share, const Substep& substep) {
  constexpr std::array<float, 4> weight{1.0f / 6, 1.0f / 3, 1.0f / 3, 1.0f / 6}, ahead{0.5f, 0.5f, 1.0f, 0.0f};
  const float h = substep.h;
  for (const Batch* batch : share.batches) {
    motion.copy(*batch, positions, start_x);
    motion.copy(*batch, velocities, start_v);
    motion.clear(*batch, mean_v);
    motion.clear(*batch, mean_a);
  }
  for (std::size_t s = 0; s < 4; ++s) {
    motion.contact_forces(share, s == 0 ? h : 0);  // friction's springs slip, and impacts are summed, once a step
    for (const Batch* batch : share.batches) motion.all_forces(*batch);
    for (const Batch* batch : share.batches) {
      stage(motion, *batch, weight[s], ahead[s] * h);
      motion.show(*batch);
    }
    share.barrier();
  }
  for (const Batch* batch : share.batches) motion.copy(*batch, mean_v, velocities);
  motion.contacts(share, h);
  for (const Batch* batch : share.batches) {
    motion.drift(*batch, h);
    motion.add(*batch, velocities, -1, mean_v);  // what the contacts have changed
    motion.add(*batch, velocities, 1, start_v);
    motion.add(*batch, velocities, h, mean_a);
  }
  motion.contacts_at_end(share, h);
  for (const Batch* batch : share.batches) motion.show(*batch);
  share.barrier();
}

}  // namespace softbody
