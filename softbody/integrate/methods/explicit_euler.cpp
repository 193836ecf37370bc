#include "softbody/integrate/integrator_steps.h"
#include "softbody/integrate/motion.h"

namespace softbody {

void explicit_euler(Motion& motion, const BatchShare& share, const Substep& substep) {
  if (substep.first) {  // the velocities at hand may be another step's
    motion.contacts(share, substep.h);
    for (const Batch* batch : share.batches) motion.show(*batch);
    share.barrier();
  }
  motion.contact_forces(share, substep.h);
  for (const Batch* batch : share.batches) {
    motion.all_forces(*batch);
    motion.drift(*batch, substep.h);
    motion.kick(*batch, substep.h);
  }
  motion.contacts_at_end(share, substep.h);
  for (const Batch* batch : share.batches) motion.show(*batch);
  share.barrier();
}

}  // namespace softbody
