#include "softbody/integrate/integrator_steps.h"
#include "softbody/integrate/motion.h"

namespace softbody {

void velocity_verlet(Motion& motion, const Worker& worker, const Substep& substep) {
  const float half = 0.5f * substep.h;
  if (substep.first) {
    motion.contact_forces(worker, 0);
    for (const Batch* batch : worker.batches()) motion.all_forces(*batch);
  }
  for (const Batch* batch : worker.batches()) motion.kick(*batch, half);
  motion.contacts(worker, substep.h);
  for (const Batch* batch : worker.batches()) {
    motion.drift(*batch, substep.h);
    motion.copy(*batch, velocities, scratch(0));
    motion.kick(*batch, half);  // the prediction
    motion.show(*batch);
  }
  worker.barrier();
  motion.contact_forces(worker, substep.h);
  for (const Batch* batch : worker.batches()) {
    motion.all_forces(*batch);
    motion.copy(*batch, scratch(0), velocities);
    motion.kick(*batch, half);
  }
  motion.contacts_at_end(worker, substep.h);
  for (const Batch* batch : worker.batches()) motion.show(*batch);
  worker.barrier();
}

}  // namespace softbody
