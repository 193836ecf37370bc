#pragma once
// The solids of a scene in doubles: one after another, how far away they are, and as the kernels want them.

#include <glm/geometric.hpp>

#include "softbody/scene.h"
#include "softbody/solid_shapes.h"

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

template <class Real>
body::Vec<Real> as_vec(const glm::dvec3& v) {
  return {Real(v.x), Real(v.y), Real(v.z)};
}

// What the kernels see of a solid that particles keep `thickness` m away from: its shape, grown by as much, and the
// place that it is seen from. A plane's is the foot of `near` on it: numbers stay small near a body.
template <class Real>
SphereShape<Real> shape_of(const SolidSphere& s, double thickness) {
  return {Real(s.radius + thickness)};
}
template <class Real>
PlaneShape<Real> shape_of(const SolidPlane& p, double) {
  return {as_vec<Real>(p.normal)};
}
template <class Real>
BoxShape<Real> shape_of(const SolidBox& b, double thickness) {
  return {{as_vec<Real>(b.axes[0]), as_vec<Real>(b.axes[1]), as_vec<Real>(b.axes[2])},
          as_vec<Real>(b.half_size),
          Real(thickness)};
}
template <class Real>
CapsuleShape<Real> shape_of(const SolidCapsule& c, double thickness) {
  return {as_vec<Real>(c.to - c.from), Real(c.radius + thickness)};
}

inline glm::dvec3 place_of(const SolidSphere& s, double, const glm::dvec3&) { return s.centre; }
inline glm::dvec3 place_of(const SolidPlane& p, double thickness, const glm::dvec3& near) {
  return near + (glm::dot(p.point - near, p.normal) + thickness) * p.normal;
}
inline glm::dvec3 place_of(const SolidBox& b, double, const glm::dvec3&) { return b.centre; }
inline glm::dvec3 place_of(const SolidCapsule& c, double, const glm::dvec3&) { return c.from; }

struct SolidSurface {
  double distance;    // m, negative inside
  glm::dvec3 normal;  // unit, out of the solid
};
/// The surface of one solid as seen from a point.
template <class Solid>
SolidSurface surface_at(const Solid& solid, const glm::dvec3& point) {
  const auto s = body::surface_at(shape_of<double>(solid, 0), as_vec<double>(point - place_of(solid, 0, point)));
  return {s.distance, {s.normal.x, s.normal.y, s.normal.z}};
}

}  // namespace softbody
