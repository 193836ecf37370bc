#include "softbody/integrate/integrator_steps.h"
#include "softbody/integrate/motion.h"

namespace softbody {

void explicit_euler(Motion& motion, const Worker& worker, const Substep& substep) {
  if (substep.first) {  // the velocities at hand may be another step's
    motion.contacts(worker, substep.h);
    for (const Batch* batch : worker.batches()) motion.show(*batch);
    worker.barrier();
  }
  motion.contact_forces(worker, substep.h);
  for (const Batch* batch : worker.batches()) {
    motion.all_forces(*batch);
    motion.drift(*batch, substep.h);
    motion.kick(*batch, substep.h);
  }
  motion.contacts_at_end(worker, substep.h);
  for (const Batch* batch : worker.batches()) motion.show(*batch);
  worker.barrier();
}

}  // namespace softbody
