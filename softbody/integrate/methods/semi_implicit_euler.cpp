#include "softbody/integrate/integrator_steps.h"
#include "softbody/integrate/motion.h"

namespace softbody {

void semi_implicit_euler(Motion& motion, const BatchShare& share, const Substep& substep) {
  motion.contact_forces(share, substep.h);
  for (const Batch* batch : share.batches) motion.advance_velocities(share, *batch, substep.h, Volumes::explicit_);
  motion.contacts(share, substep.h);
  for (const Batch* batch : share.batches) motion.advance_positions(share, *batch, substep.h);
  share.barrier();
}

}  // namespace softbody
