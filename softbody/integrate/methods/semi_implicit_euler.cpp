#include "softbody/integrate/integrator_steps.h"
#include "softbody/integrate/motion.h"

namespace softbody {

void semi_implicit_euler(Motion& motion, const Worker& worker, const Substep& substep) {
  motion.contact_forces(worker, substep.h);
  for (const Batch* batch : worker.batches()) motion.advance_velocities(worker, *batch, substep.h, Volumes::explicit_);
  motion.contacts(worker, substep.h);
  for (const Batch* batch : worker.batches()) motion.advance_positions(worker, *batch, substep.h);
  worker.barrier();
}

}  // namespace softbody
