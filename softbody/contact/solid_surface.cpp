#include "softbody/contact/solid_surface.h"

#include "softbody/contact/solid_placement.h"
#include "softbody/contact/solid_shapes.h"

namespace softbody {
namespace {

template <class Solid>
SolidSurface surface_of(const Solid& solid, const glm::dvec3& point) {
  const auto s = body::surface_at(shape_of<double>(solid, 0), as_vec<double>(point - place_of(solid, 0, point)));
  return {s.distance, {s.normal.x, s.normal.y, s.normal.z}};
}

}  // namespace

SolidSurface surface_at(const SolidSphere& s, const glm::dvec3& point) { return surface_of(s, point); }
SolidSurface surface_at(const SolidPlane& p, const glm::dvec3& point) { return surface_of(p, point); }
SolidSurface surface_at(const SolidBox& b, const glm::dvec3& point) { return surface_of(b, point); }
SolidSurface surface_at(const SolidCapsule& c, const glm::dvec3& point) { return surface_of(c, point); }

}  // namespace softbody
