#include "softbody/contact/solid_surface.h"

#include <limits>

#include <glm/common.hpp>

#include "softbody/contact/solid_shapes.h"

namespace softbody {

SolidSurface surface_at(const Solid& solid, const glm::dvec3& point) {
  if (!solid.enabled) return {std::numeric_limits<double>::infinity(), {0, 1, 0}};
  return std::visit(
      [&](const auto& one) {
        const auto [shape, place] = placed<double>(one, 0, point);
        const glm::dvec3 d = point - place;
        const SurfaceAt<double> s = simd::surface_at(shape, simd::Vec<double>{d.x, d.y, d.z});
        return SolidSurface{s.distance, {s.normal.x, s.normal.y, s.normal.z}};
      },
      solid.shape);
}

double gap_before(const Solid& solid, const PlacedBox& box) {
  const SolidSurface s = surface_at(solid, box.centre);
  return s.distance - glm::dot(glm::abs(s.normal), box.half_size);
}

}  // namespace softbody
