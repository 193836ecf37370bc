#pragma once
// How far away a solid is.

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

}  // namespace softbody
