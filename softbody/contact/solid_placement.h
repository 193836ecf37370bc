#pragma once
// The solids of a scene as the kernels want them.

#include <glm/geometric.hpp>

#include "softbody/contact/solid.h"
#include "softbody/contact/solid_arguments.h"
#include "softbody/state/lane_math.h"

namespace softbody {

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
  return {glm::vec<3, Real>(p.normal)};
}
template <class Real>
BoxShape<Real> shape_of(const SolidBox& b, double thickness) {
  using Vector = glm::vec<3, Real>;
  return {{Vector(b.axes[0]), Vector(b.axes[1]), Vector(b.axes[2])}, Vector(b.half_size), Real(thickness)};
}
template <class Real>
CapsuleShape<Real> shape_of(const SolidCapsule& c, double thickness) {
  return {glm::vec<3, Real>(c.to - c.from), Real(c.radius + thickness)};
}

inline glm::dvec3 place_of(const SolidSphere& s, double, const glm::dvec3&) { return s.centre; }
inline glm::dvec3 place_of(const SolidPlane& p, double thickness, const glm::dvec3& near) {
  return near + (glm::dot(p.point - near, p.normal) + thickness) * p.normal;
}
inline glm::dvec3 place_of(const SolidBox& b, double, const glm::dvec3&) { return b.centre; }
inline glm::dvec3 place_of(const SolidCapsule& c, double, const glm::dvec3&) { return c.from; }

}  // namespace softbody
