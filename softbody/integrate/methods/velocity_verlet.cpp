#include "softbody/integrate/integrator_steps.h"
#include "softbody/integrate/motion.h"

namespace softbody {

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
    motion.show(*batch);
  }
  share.barrier();
  motion.contact_forces(share, substep.h);
  for (const Batch* batch : share.batches) {
    motion.all_forces(*batch);
    motion.copy(*batch, scratch(0), velocities);
    motion.kick(*batch, half);
  }
  motion.contacts_at_end(share, substep.h);
  for (const Batch* batch : share.batches) motion.show(*batch);
  share.barrier();
}

}  // namespace softbody
