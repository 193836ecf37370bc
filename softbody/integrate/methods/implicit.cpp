#include "softbody/integrate/integrator_steps.h"
#include "softbody/integrate/motion.h"

namespace softbody {

void implicit_step(Motion& motion, const Worker& worker, const Substep& substep) {
  constexpr Quantity mean = scratch(0), rest = scratch(1);
  motion.contact_forces(worker, substep.h);
  for (const Batch* batch : worker.batches()) motion.solve_implicit(worker, *batch, mean, rest, substep.h);
  worker.barrier();  // no thread still reads the velocities for penalty contacts
  for (const Batch* batch : worker.batches()) {
    motion.copy(*batch, mean, velocities);
    motion.note_velocities(*batch);
    motion.pull(*batch, substep.h);
  }
  motion.contacts(worker, substep.h);
  for (const Batch* batch : worker.batches()) {
    motion.drift(*batch, substep.h);
    motion.add(*batch, velocities, 1, rest);
    motion.show(*batch);
  }
  worker.barrier();
}

}  // namespace softbody
