#include "softbody/integrate/integrator_steps.h"
#include "softbody/integrate/motion.h"

namespace softbody {

void imex_euler(Motion& motion, const Worker& worker, const Substep& substep) {
  motion.contact_forces(worker, substep.h);
  for (const Batch* batch : worker.batches()) motion.advance_velocities(worker, *batch, substep.h, Volumes::implicit_);
  motion.contacts_under_pressure(worker, substep.h);
  for (const Batch* batch : worker.batches()) motion.advance_positions(worker, *batch, substep.h);
  worker.barrier();
}

}  // namespace softbody
