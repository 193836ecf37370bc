#pragma once
// What resists a body's motion as a whole, once a frame.

#include <span>

#include "softbody/contact/solid_contact.h"
#include "softbody/state/state.h"

namespace softbody {

struct Plan;

/// Returns the rate (1/s) at which a body's velocities relax towards its rigid motion: the material's, or that of shape
/// matching, 2 zeta w, where this is more. The swings that shape matching alone holds have no other damper.
double internal_damping(const BodyModel& model);

/// The resistances are found from a body's rigid part v + w x r:
/// internal damping relaxes the particles' velocities towards it, at the rate internal_damping(), and changes neither
/// linear nor angular momentum (Mueller et al. 2007, section 3.5); rolling resistance takes up to coefficient * radius
/// * normal impulse of the angular momentum; rebound damping is Hunt and Crossley's (1975): a contact force N that acts
/// on a body which moves along it at u becomes N (1 - u / rebound_speed). What this and the contact itself have taken
/// in an impact, restitution gives back in part: see contact/rebound.h.
class Resistance {
 public:
  /// Takes those that the plan has; none acts before.
  void set_plan(const Plan& plan);
  /// Changes the velocities of the bodies of a batch that move, after a frame of `seconds`. Of each lane, `pushes`:
  /// what solids did to its body; `impacts`: that on solids, kept from frame to frame.
  void apply(const BatchView& batch, std::span<const SolidPush> pushes, double seconds,
             std::span<Impact> impacts) const;

 private:
  bool internal_ = false, rebound_ = false, rolling_ = false, restitution_ = false;
};

}  // namespace softbody
