#include "softbody/integrate/dynamics.h"
#include "softbody/integrate/integrator_steps.h"

namespace softbody {

void velocity_verlet(Dynamics& dynamics, int thread, const Substep& substep) {
  const float half = 0.5f * substep.h;
  if (substep.first) {
    dynamics.contact_forces(thread, 0);
    for (Batch* batch : dynamics.share(thread)) dynamics.all_forces(*batch);
  }
  for (Batch* batch : dynamics.share(thread)) dynamics.kick(*batch, half);
  dynamics.contacts(thread, substep.h);
  for (Batch* batch : dynamics.share(thread)) {
    dynamics.drift(*batch, substep.h);
    dynamics.copy(*batch, velocities, scratch(0));
    dynamics.kick(*batch, half);  // the prediction
  }
  dynamics.barrier();
  dynamics.contact_forces(thread, substep.h);
  for (Batch* batch : dynamics.share(thread)) {
    dynamics.all_forces(*batch);
    dynamics.copy(*batch, scratch(0), velocities);
    dynamics.kick(*batch, half);
  }
  dynamics.contacts_at_end(thread, substep.h);
  dynamics.barrier();
}

}  // namespace softbody
