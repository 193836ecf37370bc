#pragma once
// Momentum and energy balance of implicit steps.

#include "softbody/integrate/implicit/attempts.h"

namespace softbody {

/// Corrects end_v of the lanes so that their bodies end with the linear and angular momentum that is due: springs and
/// gas change neither, gravity and penalty contacts do. Solids must not push the bodies. A solve that stops early loses
/// some of both.
void restore_momentum(const ImplicitStep& step, ImplicitBodies& bodies, LaneMask which);

/// Returns true if a step of h has changed the momentum of a lane's body by the impulse of gravity and contact forces,
/// to within a tenth.
bool satisfies_momentum_balance(const BodyModel& model, const ImplicitBodies& bodies, std::size_t lane, double h,
                                const glm::dvec3& gravity);

/// Returns the energy (J) that the body in a lane has gained in a step from nowhere: the change of its elastic, gas,
/// shape and kinetic energy minus the work of gravity, solids and penalty contacts. Returns 0 if the gain is
/// negligible. A step of second order can gain energy if the body deforms far in it; a step of first order can if the
/// body rolls or the solve has not converged. pushed: solids push the body.
double energy_gain(const BodyModel& model, const ImplicitBodies& bodies, std::size_t lane, const glm::dvec3& gravity,
                   bool pushed);

/// Reduces the energy at the end of a step by `energy` (J): slows all motion of a body that is pushed, and only the
/// deformation of others, so that they keep their momentum. Returns false and changes nothing if `energy` is more than
/// a twentieth of the energy of the motion that would be slowed.
bool dissipate(const BodyModel& model, ImplicitBodies& bodies, std::size_t lane, double energy, bool pushed);

}  // namespace softbody
