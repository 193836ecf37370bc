#include "softbody/integrate/dynamics.h"
#include "softbody/integrate/integrator_steps.h"

namespace softbody {

void explicit_euler(Dynamics& dynamics, const Worker& worker, const Substep& substep) {
  if (substep.first) {  // the velocities at hand may be another step's
    dynamics.contacts(worker, substep.h);
    worker.barrier();
  }
  dynamics.contact_forces(worker, substep.h);
  for (Batch* batch : worker.batches()) {
    dynamics.all_forces(*batch);
    dynamics.drift(*batch, substep.h);
    dynamics.kick(*batch, substep.h);
  }
  dynamics.contacts_at_end(worker, substep.h);
  worker.barrier();
}

}  // namespace softbody
