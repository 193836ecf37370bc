#include "softbody/integrate/integrator_steps.h"
#include "softbody/integrate/motion.h"

namespace softbody {

void imex_euler(Motion& motion, const BatchShare& share, const Substep& substep) {
  motion.contact_forces(share, substep.h);
  for (const Batch* batch : share.batches) motion.advance_velocities(share, *batch, substep.h, Volumes::implicit_);
  motion.contacts_under_pressure(share, substep.h);
  for (const Batch* batch : share.batches) motion.advance_positions(share, *batch, substep.h);
  share.barrier();
}

}  // namespace softbody
