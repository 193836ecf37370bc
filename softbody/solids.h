#pragma once
// The solids of a scene: one after another, and how far away they are.

#include "softbody/scene.h"

namespace softbody {

inline SolidPlane as_plane(const Ground& g) { return {{0, g.height, 0}, {0, 1, 0}, g.friction, g.restitution}; }

/// Visits each solid, in the order in which a step takes them; the ground comes as a plane.
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

struct SolidSurface {
  double distance;    // m, negative inside
  glm::dvec3 normal;  // unit, out of the solid
};
// The surface of one solid as seen from a point.
SolidSurface surface_at(const SolidSphere& solid, const glm::dvec3& point);
SolidSurface surface_at(const SolidPlane& solid, const glm::dvec3& point);
SolidSurface surface_at(const SolidBox& solid, const glm::dvec3& point);
SolidSurface surface_at(const SolidCapsule& solid, const glm::dvec3& point);

}  // namespace softbody
