#include "softbody/integrate/implicit/planes.h"

#include <glm/geometric.hpp>

namespace softbody {
namespace {

/// Returns by how much (m) a particle's displacement is short of what its plane needs.
double missing(const ImplicitWork& work, const PlaneContact& c) {
  return c.min_displacement - glm::dot(read(work.end_x, c.at) - read(work.x, c.at), c.normal);
}

}  // namespace

LaneMask behind_planes(const ImplicitWork& work) {
  LaneMask behind;
  for (const PlaneContact& c : work.planes)
    if (missing(work, c) > 0) behind.set(c.at % implicit_lanes);
  return behind;
}

void clear_planes(ImplicitWork& work, LaneMask which, double h) {
  bool any = true;
  for (int pass = 0; any && pass < plane_passes; ++pass) {
    any = false;
    for (const PlaneContact& c : work.planes) {
      const double by = missing(work, c);
      if (!which[c.at % implicit_lanes] || !(by > 0)) continue;
      any = true;
      add(work.end_x, c.at, by * c.normal);
      add(work.end_v, c.at, by / h * c.normal);
    }
  }
}

}  // namespace softbody
