#include "softbody/semi_implicit_euler.h"

#include "softbody/dynamics.h"

namespace softbody {

void semi_implicit_euler(Dynamics& dynamics, int thread, float h) {
  dynamics.contact_forces(thread, h);
  for (Batch* batch : dynamics.share(thread)) {
    dynamics.forces(*batch);
    dynamics.kick(*batch, h);
  }
  dynamics.surface_contacts(thread, h);
  for (Batch* batch : dynamics.share(thread)) {
    dynamics.solids(*batch, h);
    dynamics.drift(*batch, h);
  }
  dynamics.barrier();  // the next contact forces read the positions of all bodies
}

}  // namespace softbody
