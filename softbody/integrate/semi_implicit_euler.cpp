#include "softbody/integrate/dynamics.h"
#include "softbody/integrate/integrator_steps.h"

namespace softbody {

void semi_implicit_euler(Dynamics& dynamics, int thread, const Substep& substep) {
  dynamics.contact_forces(thread, substep.h);
  for (Batch* batch : dynamics.share(thread)) {
    dynamics.all_forces(*batch);
    dynamics.kick(*batch, substep.h);
  }
  dynamics.contacts(thread, substep.h);
  for (Batch* batch : dynamics.share(thread)) dynamics.drift(*batch, substep.h);
  dynamics.barrier();  // the next contact forces read the positions of all bodies
}

}  // namespace softbody
