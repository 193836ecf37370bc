#include "softbody/integrate/implicit/planes.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace softbody {
namespace {

/// Returns by how much (m) a point's displacement is short of what its plane needs.
double missing(const ImplicitBodies& bodies, const PlaneContact& c) {
  const glm::dvec3 moved = c.point.mean([&](std::size_t at) { return read(bodies.end_x, at) - read(bodies.x, at); });
  return c.min_displacement - glm::dot(moved, c.normal);
}

}  // namespace

bool is_held(const ImplicitBodies& bodies, std::size_t at) {
  return bodies.holds[at % implicit_lanes] && std::ranges::count(bodies.held, at, &HeldEnd::at) > 0;
}

LaneMask behind_planes(const ImplicitBodies& bodies) {
  LaneMask behind;
  for (const PlaneContact& c : bodies.planes)
    if (missing(bodies, c) > 0) behind.set(c.point.lane());
  return behind;
}

void clear_planes(ImplicitBodies& bodies, LaneMask which, double h) {
  bool any = true;
  for (int pass = 0; any && pass < plane_passes; ++pass) {
    any = false;
    for (const PlaneContact& c : bodies.planes) {
      const double by = missing(bodies, c);
      if (!which[c.point.lane()] || !(by > 0)) continue;
      any = true;
      BodyPoint free = c.point;
      for (std::size_t k = 0; k < 3; ++k)
        if (is_held(bodies, free.at[k])) free.weight[k] = 0;
      const glm::dvec3 move = by / free.square_of_weights() * c.normal;
      free.add_to(bodies.end_x, move);
      free.add_to(bodies.end_v, move / h);
    }
  }
}

}  // namespace softbody
