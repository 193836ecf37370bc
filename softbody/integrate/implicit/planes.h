#pragma once
// Corrections of an implicit step whose solve has left particles behind planes.

#include <algorithm>
#include <span>

#include <glm/geometric.hpp>

#include "softbody/contact/law.h"
#include "softbody/integrate/implicit/solver.h"

namespace softbody {

inline constexpr int plane_passes = 8;  // over planes that conflict with each other

/// Returns how far (m) a lane's body shifts as a whole in a step of h: by `meant`, unless its planes stop it. aside(i):
/// m, by which particle i moves relative to that shift.
template <class Aside>
glm::dvec3 stop_at(std::span<const PlaneContact> planes, std::size_t lane, double h, const glm::dvec3& meant,
                   const Aside& aside) {
  const double max_shift = glm::length(meant) + h * law::max_separation_speed;
  glm::dvec3 shift = meant;
  bool stands = false;
  for (int pass = 0; !stands && pass < plane_passes; ++pass) {
    stands = true;
    for (const PlaneContact& c : planes) {
      if (c.at % implicit_lanes != lane) continue;
      const double more = c.min_displacement - glm::dot(shift + aside(c.at / implicit_lanes), c.normal);
      if (!(more > 0)) continue;
      shift += more * c.normal;
      stands = false;
    }
  }
  // Between planes that face each other the passes do not converge.
  if (const double length = glm::length(shift); length > max_shift) shift *= max_shift / length;
  return shift;
}

/// Returns the lanes in which work.end_x is behind one of work.planes.
std::array<bool, implicit_lanes> behind_planes(const ImplicitWork& work);

/// Moves each particle that ends behind its planes in front of them. A solve that has not converged leaves such
/// particles.
void clear_planes(ImplicitWork& work, double h);

/// True if a step of h has changed the momentum of a lane's body by the impulse of gravity and contact forces, to
/// within a tenth.
bool satisfies_momentum_balance(const BodyModel& model, const ImplicitWork& work, std::size_t lane, double h,
                                const glm::dvec3& gravity);

/// Replaces the end of a step of h whose solve cannot be trusted: the body in the lane moves and rotates as a rigid
/// body and stops at its planes. If that would give it energy, it rotates about its angular momentum instead; if that
/// does, too, its spin is reduced. Its shape does not change, and its deformation velocities are lost.
void rigid_fallback_step(ImplicitWork& work, std::size_t lane, double h, const glm::dvec3& gravity);

}  // namespace softbody
