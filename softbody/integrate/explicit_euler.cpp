#include "softbody/integrate/dynamics.h"
#include "softbody/integrate/integrator_steps.h"

namespace softbody {

void explicit_euler(Dynamics& dynamics, int thread, const Substep& substep) {
  if (substep.first) {  // the velocities at hand may be another step's
    dynamics.contacts(thread, substep.h);
    dynamics.barrier();
  }
  dynamics.contact_forces(thread, substep.h);
  for (Batch* batch : dynamics.share(thread)) {
    dynamics.all_forces(*batch);
    dynamics.drift(*batch, substep.h);
    dynamics.kick(*batch, substep.h);
  }
  dynamics.contacts_at_end(thread, substep.h);
  dynamics.barrier();
}

}  // namespace softbody
