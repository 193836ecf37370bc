#pragma once
// Visits the solids of a scene.

#include <algorithm>
#include <limits>

#include "softbody/contact/solid_surface.h"
#include "softbody/scene/scene.h"

namespace softbody {

inline SolidPlane as_plane(const Ground& g) { return {{0, g.height, 0}, {0, 1, 0}, g.friction, g.restitution}; }

/// Calls visit(solid) for each solid, in the order in which a step handles them. The ground is visited as a plane.
template <class Visit>
void for_each_solid(const Scene& scene, Visit visit) {
  for (const SolidSphere& s : scene.spheres) visit(s);
  if (scene.ground) visit(as_plane(*scene.ground));
  for (const SolidPlane& p : scene.planes) visit(p);
  for (const SolidBox& b : scene.boxes) visit(b);
  for (const SolidCapsule& c : scene.capsules) visit(c);
}

inline bool has_solids(const Scene& scene) {
  bool any = false;
  for_each_solid(scene, [&any](const auto&) { any = true; });
  return any;
}

/// Returns the unit vector along which a box leaves a solid soonest, without going deeper into another one: one of the
/// scene's axes, or away from where the solid's surface is nearest.
template <class Solid>
glm::dvec3 way_out(const Scene& scene, const Solid& solid, const PlacedBox& box) {
  const glm::dvec3 nearest = surface_at(solid, box.centre).normal;
  const double size = glm::length(box.half_size);
  glm::dvec3 best = nearest;
  double shortest = std::numeric_limits<double>::infinity();
  const auto consider = [&](const glm::dvec3& way) {
    PlacedBox at = box;
    constexpr int steps = 100;
    double length = 0;
    for (int i = 0; i < steps && gap_before(solid, at) < 0; ++i) {
      length += std::max(-gap_before(solid, at), 0.05 * size);
      at.centre = box.centre + length * way;
    }
    bool free = length < shortest && gap_before(solid, at) >= 0;
    for_each_solid(scene, [&](const auto& other) {
      const double now = gap_before(other, at);
      free = free && (now >= 0 || now >= gap_before(other, box));
    });
    if (free) best = way, shortest = length;
  };
  consider(nearest);
  for (const glm::dvec3& way : {glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1)})
    consider(way), consider(-way);
  return best;
}

}  // namespace softbody
