#include "softbody/integrate/implicit/steps.h"
#include "softbody/integrate/integrator_steps.h"
#include "softbody/integrate/motion.h"

namespace softbody {

void Motion::solve_implicit(const Worker& worker, const Batch& b, Quantity mean, Quantity rest, float h) {
  const State& state = parts_.state;
  PenaltyContact& penalty = parts_.penalty;
  parts_.implicit.advance(worker.index(),
                          {.batch = b,
                           .x = field(state.x),
                           .v = field(state.v),
                           .gravity = gravity_,
                           .near_solids = parts_.solids.near(b),
                           .features = parts_.solids.find_feature_rows(b, h),
                           .penalty = penalty,
                           .ends = penalty.ends_of(b),
                           .is_moving = [&state](BodyId body) { return state.body(body).moves(); }},
                          {field(array(mean)), field(array(rest)), parts_.solids.sums(b)}, double(h));
}

void implicit_step(Motion& motion, const Worker& worker, const Substep& substep) {
  constexpr Quantity mean = scratch(0), rest = scratch(1);
  motion.contact_forces(worker, substep.h);
  for (const Batch* batch : worker.batches()) motion.solve_implicit(worker, *batch, mean, rest, substep.h);
  worker.barrier();  // no thread still reads the velocities for penalty contacts
  for (const Batch* batch : worker.batches()) {
    motion.copy(*batch, mean, velocities);
    motion.note_velocities(*batch);
    motion.pull(*batch, substep.h);
  }
  motion.contacts(worker, substep.h);
  for (const Batch* batch : worker.batches()) {
    motion.drift(*batch, substep.h);
    motion.add(*batch, velocities, 1, rest);
    motion.show(*batch);
  }
  worker.barrier();
}

}  // namespace softbody
