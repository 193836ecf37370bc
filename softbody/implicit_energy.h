#pragma once
// What an implicit step has gained in energy.

#include "softbody/implicit_solver.h"

namespace softbody {

/// J that springs, gas and motion of the body in a lane have more at the end of a step than at its start and from
/// gravity and contact_work (J), above what adds up to little: a step of second order can gain, where the body swings
/// far in one, and so can one of first order that rolls, or that has not converged. What keeps its shape by shape
/// matching is not judged.
double undue_energy(const Prototype& prototype, const ImplicitWork& work, std::size_t lane, const glm::dvec3& gravity,
                    double contact_work);

/// Slows the end of a step until it has so much less energy of motion; false, and nothing done, if that is more than a
/// twentieth of it.
bool take_back(const Prototype& prototype, ImplicitWork& work, std::size_t lane, double energy);

/// J that solids and shields may have done on a lane's body in the step that ends at work.end_x.
double contact_work(const ImplicitWork& work, std::size_t lane);

}  // namespace softbody
