#include "softbody/integrate/integrator_steps.h"
#include "softbody/integrate/motion.h"

namespace softbody {

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
  for (const Batch* batch : share.batches) {
    motion.drift(*batch, substep.h);
    motion.show(*batch);
  }
  share.barrier();
}

}  // namespace softbody
