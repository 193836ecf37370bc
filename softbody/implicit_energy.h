#pragma once
// What an implicit step has gained in energy.

#include "softbody/implicit_solver.h"

namespace softbody {

/// Whether springs, gas and motion of the body in a lane have more energy at the end of a step than at its start and
/// from gravity, by more than what adds up to little: a step of second order can, where the body swings far in one.
/// What keeps its shape by shape matching is not judged.
bool gains_energy(const Prototype& prototype, const ImplicitWork& work, std::size_t lane, const glm::dvec3& gravity);

}  // namespace softbody
