#include "softbody/integrate/dynamics.h"
#include "softbody/integrate/integrator_steps.h"

namespace softbody {

void velocity_verlet(Dynamics& dynamics, const Worker& worker, const Substep& substep) {
  const float half = 0.5f * substep.h;
  if (substep.first) {
    dynamics.contact_forces(worker, 0);
    for (Batch* batch : worker.batches()) dynamics.all_forces(*batch);
  }
  for (Batch* batch : worker.batches()) dynamics.kick(*batch, half);
  dynamics.contacts(worker, substep.h);
  for (Batch* batch : worker.batches()) {
    dynamics.drift(*batch, substep.h);
    dynamics.copy(*batch, velocities, scratch(0));
    dynamics.kick(*batch, half);  // the prediction
  }
  worker.barrier();
  dynamics.contact_forces(worker, substep.h);
  for (Batch* batch : worker.batches()) {
    dynamics.all_forces(*batch);
    dynamics.copy(*batch, scratch(0), velocities);
    dynamics.kick(*batch, half);
  }
  dynamics.contacts_at_end(worker, substep.h);
  worker.barrier();
}

}  // namespace softbody
