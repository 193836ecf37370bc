#include "softbody/integrate/dynamics.h"
#include "softbody/integrate/integrator_steps.h"

namespace softbody {

void semi_implicit_euler(Dynamics& dynamics, const Worker& worker, const Substep& substep) {
  dynamics.contact_forces(worker, substep.h);
  for (Batch* batch : worker.batches()) {
    dynamics.all_forces(*batch);
    dynamics.kick(*batch, substep.h);
  }
  dynamics.contacts(worker, substep.h);
  for (Batch* batch : worker.batches()) dynamics.drift(*batch, substep.h);
  worker.barrier();  // the next contact forces read the positions of all bodies
}

}  // namespace softbody
