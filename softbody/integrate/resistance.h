#pragma once
// What resists a body's motion as a whole, once a frame.

#include <span>

#include "softbody/contact/solid_contact.h"
#include "softbody/state/state.h"

namespace softbody {

struct Plan;

/// The resistances are found from a body's rigid part v + w x r:
/// internal damping relaxes the particles' velocities towards it, at the material's rate, and changes neither linear
/// nor angular momentum (Mueller et al. 2007, section 3.5); rolling resistance takes up to coefficient * radius *
/// normal impulse of the angular momentum; rebound damping is Hunt and Crossley's (1975): a contact force N that acts
/// on a body which moves along it at u becomes N (1 - u / rebound_speed), but for what restitution keeps of u.
class Resistance {
 public:
  /// Takes those of the three that the plan has; none acts before.
  void set_plan(const Plan& plan);
  /// Changes the velocities of the bodies of a batch that move, after a frame of `seconds`. Of each lane, `pushes`:
  /// what solids did to its body; `impacts`: the speed (m/s) with which it came upon the solids that it touches, kept
  /// from frame to frame, 0 at first.
  void apply(const BatchView& batch, std::span<const SolidPush> pushes, double seconds,
             std::span<double> impacts) const;

 private:
  bool internal_ = false, rebound_ = false, rolling_ = false;
};

}  // namespace softbody
