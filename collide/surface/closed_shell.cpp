#include "collide/surface/closed_shell.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "collide/core/vertex_kernels.h"
#include "collide/surface/closest_features.h"

namespace collide::surface {

ClosedShell::ClosedShell(const Surface& surface, const VertexRun& at) : surface_(surface), at_(at) {
  const BodyBounds bound = measure_bounds(at);
  if (!bound.finite) return;
  // Distances to faces are rounded in float: they may be this much less than those to the exact boxes.
  const glm::dvec3 hair(1e-6 * double(bound.largest));
  std::vector<Box> boxes(surface.triangles().size());
  for (Index t = 0; t < boxes.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) boxes[t].add(glm::dvec3(corner(t, k)));
    boxes[t].lo -= hair;
    boxes[t].hi += hair;
  }
  faces_ = BoxTree(boxes);
}

bool ClosedShell::inside(const glm::vec3& point) const {
  const glm::dvec3 from(point), way(0.5377, 0.7141, 0.4486);  // along nothing that a mesh is likely to be aligned with
  if (!overlap(faces_.box(), {from, from})) return false;
  const auto on_the_way = [&](const Box& box) {
    const glm::dvec3 first = (box.lo - from) / way, last = (box.hi - from) / way;
    return std::max({0.0, first.x, first.y, first.z}) <= std::min({last.x, last.y, last.z});
  };
  bool odd = false;
  faces_.walk(on_the_way, [&](Index t) {
    glm::dvec3 to[3];
    for (std::size_t k = 0; k < 3; ++k) to[k] = glm::dvec3(corner(t, k)) - from;
    // Moeller and Trumbore (1997) by signed volumes: a side that two faces share is judged alike for both.
    const double u = glm::dot(way, glm::cross(to[0], to[1])), v = glm::dot(way, glm::cross(to[1], to[2])),
                 w = glm::dot(way, glm::cross(to[2], to[0]));
    if ((u > 0) != (v > 0) || (v > 0) != (w > 0)) return;
    const glm::dvec3 normal = glm::cross(to[1] - to[0], to[2] - to[0]);
    const double along = glm::dot(way, normal);
    if (along != 0 && glm::dot(to[0], normal) / along > 0) odd = !odd;
  });
  return odd;
}

ClosedShell::Nearest ClosedShell::nearest_face(const glm::vec3& point) const {
  Nearest nearest{0, std::numeric_limits<float>::infinity()};  // until the end the distance squared
  faces_.walk([&](const Box& box) { return squared_distance_to(box, glm::dvec3(point)) <= double(nearest.distance); },
              [&](Index t) {
                const glm::vec3 apart = closest_vertex_face(point, corner(t, 0), corner(t, 1), corner(t, 2)).apart;
                const float squared = glm::dot(apart, apart);
                if (squared < nearest.distance || (squared == nearest.distance && t < nearest.face))
                  nearest = {t, squared};
              });
  nearest.distance = std::sqrt(nearest.distance);
  return nearest;
}

}  // namespace collide::surface
