#include "softbody/integrate/integrator_steps.h"

#include <array>

#include "softbody/integrate/motion.h"

namespace softbody {

void explicit_euler(Motion& motion, const BatchShare& share, const Substep& substep) {
  if (substep.first) {  // the velocities at hand may be another step's
    motion.contacts(share, substep.h);
    motion.show(share);
  }
  motion.contact_forces(share, substep.h);
  for (const Batch* batch : share.batches) {
    motion.all_forces(*batch);
    motion.drift(*batch, substep.h);
    motion.kick(*batch, substep.h);
  }
  motion.contacts_at_end(share, substep.h);
  motion.show(share);
}

void semi_implicit_euler(Motion& motion, const BatchShare& share, const Substep& substep) {
  motion.contact_forces(share, substep.h);
  for (const Batch* batch : share.batches) motion.advance_velocities(share, *batch, substep.h, Volumes::explicit_);
  motion.contacts(share, substep.h);
  for (const Batch* batch : share.batches) motion.advance_positions(share, *batch, substep.h);
  share.barrier();
}

void imex_euler(Motion& motion, const BatchShare& share, const Substep& substep) {
  motion.contact_forces(share, substep.h);
  for (const Batch* batch : share.batches) motion.advance_velocities(share, *batch, substep.h, Volumes::implicit_);
  motion.contacts_under_pressure(share, substep.h);
  for (const Batch* batch : share.batches) motion.advance_positions(share, *batch, substep.h);
  share.barrier();
}

void velocity_verlet(Motion& motion, const BatchShare& share, const Substep& substep) {
  const float half = 0.5f * substep.h;
  if (substep.first) {
    motion.contact_forces(share, 0);
    for (const Batch* batch : share.batches) motion.all_forces(*batch);
  }
  for (const Batch* batch : share.batches) motion.kick(*batch, half);
  motion.contacts(share, substep.h);
  for (const Batch* batch : share.batches) {
    motion.drift(*batch, substep.h);
    motion.copy(*batch, velocities, scratch(0));
    motion.kick(*batch, half);  // the prediction
  }
  motion.show(share);
  motion.contact_forces(share, substep.h);
  for (const Batch* batch : share.batches) {
    motion.all_forces(*batch);
    motion.copy(*batch, scratch(0), velocities);
    motion.kick(*batch, half);
  }
  motion.contacts_at_end(share, substep.h);
  motion.show(share);
}

void runge_kutta_4(Motion& motion, const BatchShare& share, const Substep& substep) {
  constexpr Quantity start_x = scratch(0), start_v = scratch(1), mean_v = scratch(2), mean_a = scratch(3);
  constexpr std::array<float, 4> weight{1.0f / 6, 1.0f / 3, 1.0f / 3, 1.0f / 6}, ahead{0.5f, 0.5f, 1.0f, 0.0f};
  const float h = substep.h;
  for (const Batch* batch : share.batches) {
    motion.copy(*batch, positions, start_x);
    motion.copy(*batch, velocities, start_v);
    motion.clear(*batch, mean_v);
    motion.clear(*batch, mean_a);
  }
  for (std::size_t stage = 0; stage < 4; ++stage) {
    motion.contact_forces(share, stage == 0 ? h : 0);  // friction's springs slip, and impacts are summed, once a step
    for (const Batch* batch : share.batches) motion.all_forces(*batch);
    for (const Batch* batch : share.batches) {
      motion.accelerations(*batch);
      motion.add(*batch, mean_v, weight[stage], velocities);
      motion.add(*batch, mean_a, weight[stage], forces);
      // On to where the next stage stands, so far ahead of the start.
      motion.copy(*batch, start_x, positions);
      motion.add(*batch, positions, ahead[stage] * h, velocities);
      motion.copy(*batch, start_v, velocities);
      motion.add(*batch, velocities, ahead[stage] * h, forces);
    }
    motion.show(share);
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
  motion.show(share);
}

void xpbd(Motion& motion, const BatchShare& share, const Substep& substep) {
  constexpr Quantity start = scratch(0), displacements = velocities;
  motion.contact_forces(share, substep.h);
  for (const Batch* batch : share.batches) {
    motion.other_forces(*batch);
    motion.kick(*batch, substep.h);
    motion.copy(*batch, positions, start);
    motion.drift(*batch, substep.h);
    motion.scale(*batch, velocities, substep.h);
    motion.project(*batch, start, displacements, substep.h);
    motion.scale(*batch, displacements, 1 / substep.h);
    motion.copy(*batch, start, positions);  // hand and contacts see where the velocities lead to from here
    motion.pull(*batch, substep.h);
  }
  motion.contacts(share, substep.h);
  for (const Batch* batch : share.batches) motion.drift(*batch, substep.h);
  motion.show(share);
}

void implicit_step(Motion& motion, const BatchShare& share, const Substep& substep) {
  constexpr Quantity mean = scratch(0), rest = scratch(1);
  motion.contact_forces(share, substep.h);
  for (const Batch* batch : share.batches) motion.solve_implicit(share, *batch, mean, rest, substep.h);
  share.barrier();  // no thread still reads the velocities for penalty contacts
  for (const Batch* batch : share.batches) {
    motion.copy(*batch, mean, velocities);
    motion.note_velocities(*batch);
    motion.pull(*batch, substep.h);
  }
  motion.contacts(share, substep.h);
  for (const Batch* batch : share.batches) {
    motion.drift(*batch, substep.h);
    motion.add(*batch, velocities, 1, rest);
  }
  motion.show(share);
}

}  // namespace softbody
