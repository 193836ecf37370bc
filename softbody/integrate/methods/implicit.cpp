#include "softbody/integrate/integrator_steps.h"
#include "softbody/integrate/motion.h"

namespace softbody {

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
    motion.show(*batch);
  }
  share.barrier();
}

}  // namespace softbody
