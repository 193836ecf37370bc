#include "softbody/integrate/implicit/planes.h"

#include <glm/geometric.hpp>

namespace softbody {
namespace {

/// Returns by how much (m) a point's displacement is short of what its plane needs.
double missing(const ImplicitWork& work, const PlaneContact& c) {
  const glm::dvec3 moved = c.point.mean([&](std::size_t at) { return read(work.end_x, at) - read(work.x, at); });
  return c.min_displacement - glm::dot(moved, c.normal);
}

}  // namespace

LaneMask behind_planes(const ImplicitWork& work) {
  LaneMask behind;
  for (const PlaneContact& c : work.planes)
    if (missing(work, c) > 0) behind.set(c.point.lane());
  return behind;
}

void clear_planes(ImplicitWork& work, LaneMask which, double h) {
  bool any = true;
  for (int pass = 0; any && pass < plane_passes; ++pass) {
    any = false;
    for (const PlaneContact& c : work.planes) {
      const double by = missing(work, c);
      if (!which[c.point.lane()] || !(by > 0)) continue;
      any = true;
      const glm::dvec3 move = by / c.point.square_of_weights() * c.normal;
      c.point.add_to(work.end_x, move);
      c.point.add_to(work.end_v, move / h);
    }
  }
}

}  // namespace softbody
