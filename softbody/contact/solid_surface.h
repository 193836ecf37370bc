#pragma once
// How far away a solid is.

#include "softbody/contact/solid.h"

namespace softbody {

struct SolidSurface {
  double distance;    // m, negative inside
  glm::dvec3 normal;  // unit, out of the solid
};
/// Returns the surface of a solid as seen from a point; infinitely far away if the solid is not enabled.
SolidSurface surface_at(const Solid& solid, const glm::dvec3& point);

/// The bounding box of a body.
struct PlacedBox {
  glm::dvec3 centre, half_size;  // m
};
/// Returns the distance (m) from a box to the plane before the solid, as seen from the box's middle: all of the solid
/// lies behind it. Negative where the plane cuts the box.
double gap_before(const Solid& solid, const PlacedBox& box);

}  // namespace softbody
