#pragma once
// Corrections of an implicit step whose solve has left points behind planes.

#include <span>

#include <glm/geometric.hpp>

#include "softbody/contact/law.h"
#include "softbody/integrate/implicit/problem.h"

namespace softbody {

inline constexpr int plane_passes = 8;  // over planes that conflict with each other

/// Returns how far (m) a lane's body shifts as a whole in a step of h: by `meant`, unless its planes stop it. aside(i)
/// returns how far (m) particle i moves relative to that shift.
template <class Aside>
glm::dvec3 stop_at(std::span<const PlaneContact> planes, std::size_t lane, double h, const glm::dvec3& meant,
                   const Aside& aside) {
  const double max_shift = glm::length(meant) + h * law::max_separation_speed;
  glm::dvec3 shift = meant;
  bool stands = false;
  for (int pass = 0; !stands && pass < plane_passes; ++pass) {
    stands = true;
    for (const PlaneContact& c : planes) {
      if (c.point.lane() != lane) continue;
      const glm::dvec3 by = c.point.mean([&](std::size_t at) { return aside(at / implicit_lanes); });
      const double more = c.min_displacement - glm::dot(shift + by, c.normal);
      if (!(more > 0)) continue;
      shift += more * c.normal;
      stands = false;
    }
  }
  // Between planes that face each other the passes do not converge.
  if (const double length = glm::length(shift); !stands && length > max_shift) shift *= max_shift / length;
  return shift;
}

/// Returns true if something holds a particle. at: particle * implicit_lanes + lane
bool is_held(const ImplicitBodies& bodies, std::size_t at);

/// Returns the lanes in which a point ends behind one of its planes.
LaneMask behind_planes(const ImplicitBodies& bodies);

/// Moves each point of the lanes that ends behind its planes in front of them. A solve that has not converged leaves
/// such points.
void clear_planes(ImplicitBodies& bodies, LaneMask which, double h);

}  // namespace softbody
