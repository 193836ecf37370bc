#pragma once
// Visits the solids of a scene.

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

}  // namespace softbody
