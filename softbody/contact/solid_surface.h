#pragma once
// How far away a solid is.

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "softbody/contact/solid.h"

namespace softbody {

struct SolidSurface {
  double distance;    // m, negative inside
  glm::dvec3 normal;  // unit, out of the solid
};
// The surface of one solid as seen from a point.
SolidSurface surface_at(const SolidSphere& solid, const glm::dvec3& point);
SolidSurface surface_at(const SolidPlane& solid, const glm::dvec3& point);
SolidSurface surface_at(const SolidBox& solid, const glm::dvec3& point);
SolidSurface surface_at(const SolidCapsule& solid, const glm::dvec3& point);

/// The bounding box of a body.
struct PlacedBox {
  glm::dvec3 centre, half_size;  // m
};
/// Returns the distance (m) from a box to the plane before the solid, as seen from the box's middle: all of the solid
/// lies behind it. Negative where the plane cuts the box.
template <class Solid>
double gap_before(const Solid& solid, const PlacedBox& box) {
  const SolidSurface s = surface_at(solid, box.centre);
  return s.distance - glm::dot(glm::abs(s.normal), box.half_size);
}

}  // namespace softbody
