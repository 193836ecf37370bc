#include "softbody/integrate/dynamics.h"
#include "softbody/integrate/integrator_steps.h"

namespace softbody {

void xpbd(Dynamics& dynamics, const Worker& worker, const Substep& substep) {
  constexpr Quantity start = scratch(0), displacements = velocities;
  dynamics.contact_forces(worker, substep.h);
  for (Batch* batch : worker.batches()) {
    dynamics.other_forces(*batch);
    dynamics.kick(*batch, substep.h);
    dynamics.copy(*batch, positions, start);
    dynamics.drift(*batch, substep.h);
    dynamics.scale(*batch, velocities, substep.h);
    dynamics.project(*batch, start, displacements);
    dynamics.scale(*batch, displacements, 1 / substep.h);
    dynamics.copy(*batch, start, positions);  // hand and contacts see where the velocities lead to from here
    dynamics.pull(*batch);
  }
  dynamics.contacts(worker, substep.h);
  for (Batch* batch : worker.batches()) dynamics.drift(*batch, substep.h);
  worker.barrier();
}

}  // namespace softbody
