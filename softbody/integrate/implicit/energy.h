#pragma once
// What an implicit step has gained in energy.

#include "softbody/integrate/implicit/solver.h"

namespace softbody {

/// J that springs, gas, what keeps the shape, and motion of the body in a lane have more at the end of a step than at
/// its start and from gravity, solids and penalty contacts; 0 if that is so little that it adds up to little: a step of
/// second order can gain, where the body swings far in one, and so can one of first order that rolls, or that has not
/// converged. pushed: whether solids push the body.
double energy_gain(const BodyModel& model, const ImplicitWork& work, std::size_t lane, const glm::dvec3& gravity,
                   bool pushed);

/// Slows the end of a step until it has so much less energy: all motion of what is pushed, and of others what is not
/// rigid, so that they keep their momentum. False, and nothing done, if that is more than a twentieth of its energy.
bool dissipate(const BodyModel& model, ImplicitWork& work, std::size_t lane, double energy, bool pushed);

}  // namespace softbody
