#pragma once
// Momentum balance of implicit steps.

#include "softbody/integrate/implicit/attempts.h"

namespace softbody {

/// Corrects end_v of the lanes so that their bodies end with the linear and angular momentum that is due: springs and
/// gas change neither, gravity and penalty contacts do. Solids must not push the bodies. A solve that stops early loses
/// some of both.
void restore_momentum(const ImplicitStep& step, ImplicitWork& work, LaneMask which);

/// Returns true if a step of h has changed the momentum of a lane's body by the impulse of gravity and contact forces,
/// to within a tenth.
bool satisfies_momentum_balance(const BodyModel& model, const ImplicitWork& work, std::size_t lane, double h,
                                const glm::dvec3& gravity);

}  // namespace softbody
