#pragma once
// What an implicit step makes of planes that its solve has missed.

#include "softbody/implicit_solver.h"

namespace softbody {

/// In which lanes work.end_x is behind one of work.planes.
std::array<bool, lanes> behind_planes(const ImplicitWork& work);

/// Takes particles that end behind their planes before them, each by itself: a solve that has not come to its end
/// leaves some there.
void clear_planes(ImplicitWork& work, double h);

/// Whether a step of h has changed the momentum of a lane's body by what gravity and contact forces give, but for a
/// tenth.
bool keeps_balance(const Prototype& prototype, const ImplicitWork& work, std::size_t lane, double h,
                   const glm::dvec3& gravity);

/// The end of a step of h whose solve is not to be trusted: the body in the lane flies and spins on as one and stops at
/// its planes; if that would give it energy, without its spin. Its shape stays, what moves within it is lost.
void go_on_as_one(ImplicitWork& work, std::size_t lane, double h, const glm::dvec3& gravity);

}  // namespace softbody
