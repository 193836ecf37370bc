#pragma once
// What an implicit step has gained in energy.

#include "softbody/implicit_solver.h"

namespace softbody {

/// Whether springs, gas and motion of the body in a lane have more energy at the end of a step than at its start and
/// from gravity and contact_work (J), by more than what adds up to little: a step of second order can, where the body
/// swings far in one, and so can one that has not converged. What keeps its shape by shape matching is not judged.
bool gains_energy(const Prototype& prototype, const ImplicitWork& work, std::size_t lane, const glm::dvec3& gravity,
                  double contact_work);

/// J that solids and shields may have done on a lane's body in the step that ends at work.end_x.
double contact_work(const ImplicitWork& work, std::size_t lane);

}  // namespace softbody
