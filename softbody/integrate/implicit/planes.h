#pragma once
// What an implicit step makes of planes that its solve has missed.

#include <algorithm>
#include <span>

#include <glm/geometric.hpp>

#include "softbody/contact/law.h"
#include "softbody/integrate/implicit/solver.h"

namespace softbody {

inline constexpr int plane_passes = 8;  // over planes that stand in each other's way

/// How far a lane's body shifts as one in a step of h, in m, if its planes stop what is meant. aside(i): m, by which
/// particle i moves besides.
template <class Aside>
glm::dvec3 stop_at(std::span<const PlaneContact> planes, std::size_t lane, double h, const glm::dvec3& meant,
                   const Aside& aside) {
  const double max_shift = glm::length(meant) + h * law::max_separation_speed;
  glm::dvec3 shift = meant;
  bool stands = false;
  for (int pass = 0; !stands && pass < plane_passes; ++pass) {
    stands = true;
    for (const PlaneContact& c : planes) {
      if (c.at % lanes != lane) continue;
      const double more = c.min_displacement - glm::dot(shift + aside(c.at / lanes), c.normal);
      if (!(more > 0)) continue;
      shift += more * c.normal;
      stands = false;
    }
  }
  // Planes that face each other have no place for it.
  if (const double length = glm::length(shift); length > max_shift) shift *= max_shift / length;
  return shift;
}

/// In which lanes work.end_x is behind one of work.planes.
std::array<bool, lanes> behind_planes(const ImplicitWork& work);

/// Takes particles that end behind their planes before them, each by itself: a solve that has not come to its end
/// leaves some there.
void clear_planes(ImplicitWork& work, double h);

/// Whether a step of h has changed the momentum of a lane's body by what gravity and contact forces give, but for a
/// tenth.
bool satisfies_momentum_balance(const BodyModel& model, const ImplicitWork& work, std::size_t lane, double h,
                                const glm::dvec3& gravity);

/// The end of a step of h whose solve is not to be trusted: the body in the lane flies and spins on as one and stops at
/// its planes. If that would give it energy, it turns about its angular momentum instead, and if that does, with less
/// spin or none. Its shape stays, what moves within it is lost.
void rigid_fallback_step(ImplicitWork& work, std::size_t lane, double h, const glm::dvec3& gravity);

}  // namespace softbody
