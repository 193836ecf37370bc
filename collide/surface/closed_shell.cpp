#include "collide/surface/closed_shell.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>

#include "collide/core/vertex_kernels.h"
#include "collide/surface/closest_features.h"

namespace collide::surface {

ClosedShell::ClosedShell(const Surface& surface, const VertexRun& at) : surface_(surface), at_(at) {
  assert(at.size == surface.vertex_count());
  const BodyBounds bound = measure_bounds(at);
  if (!bound.finite) return;
  // The distance to a face is rounded in float: it may be less than the distance to the exact box by this much.
  const glm::dvec3 margin(1e-6 * double(bound.largest));
  std::vector<Box> boxes(surface.triangles().size());
  for (Index t = 0; t < boxes.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) boxes[t].add(glm::dvec3(corner(t, k)));
    boxes[t].lo -= margin;
    boxes[t].hi += margin;
  }
  faces_ = BoxTree(boxes);
}

bool ClosedShell::inside(const glm::vec3& point) const {
  const glm::dvec3 origin(point), direction(0.5377, 0.7141, 0.4486);  // meshes are rarely aligned with it
  if (!overlap(faces_.box(), {origin, origin})) return false;
  const auto ray_hits = [&](const Box& box) {
    const glm::dvec3 first = (box.lo - origin) / direction, last = (box.hi - origin) / direction;
    return std::max({0.0, first.x, first.y, first.z}) <= std::min({last.x, last.y, last.z});
  };
  bool odd = false;
  faces_.walk(ray_hits, [&](Index t) {
    glm::dvec3 to[3];
    for (std::size_t k = 0; k < 3; ++k) to[k] = glm::dvec3(corner(t, k)) - origin;
    // Moeller and Trumbore (1997) by signed volumes: at a common side, two faces compute the same volume but for its
    // sign.
    const double u = glm::dot(direction, glm::cross(to[0], to[1])), v = glm::dot(direction, glm::cross(to[1], to[2])),
                 w = glm::dot(direction, glm::cross(to[2], to[0]));
    if ((u > 0) != (v > 0) || (v > 0) != (w > 0)) return;
    const glm::dvec3 normal = glm::cross(to[1] - to[0], to[2] - to[0]);
    const double along = glm::dot(direction, normal);
    if (along != 0 && glm::dot(to[0], normal) / along > 0) odd = !odd;
  });
  return odd;
}

ClosedShell::Nearest ClosedShell::nearest_face(const glm::vec3& point) const {
  assert(!faces_.box().empty());
  const auto [distance, face] = faces_.nearest(glm::dvec3(point), 0, [&](Index t) {
    const glm::vec3 separation = closest_vertex_face(point, corner(t, 0), corner(t, 1), corner(t, 2)).separation;
    return std::sqrt(double(glm::dot(separation, separation)));  // in double: equal for equal squares only
  });
  return {face, static_cast<float>(distance)};
}

}  // namespace collide::surface
