#include "collide/surface/closest_features.h"

#include <glm/geometric.hpp>

#include "collide/surface/closest_parameters.h"

namespace collide::surface {

namespace {

const Closest& nearer(const Closest& a, const Closest& b) {
  return glm::dot(b.separation, b.separation) < glm::dot(a.separation, a.separation) ? b : a;
}

}  // namespace

Closest closest_vertex_face(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const auto at = [&](float v, float w, bool inner) -> Closest {
    const float u = 1 - v - w;
    return {{1, u, v, w}, p - (u * a + v * b + w * c), inner};
  };
  const glm::vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c, n = glm::cross(ab, ac);
  const FaceCoordinates m = face_coordinates(glm::dot(ab, ap), glm::dot(ac, ap), glm::dot(ab, bp), glm::dot(ac, bp),
                                             glm::dot(ab, cp), glm::dot(ac, cp));
  // In a sliver, rounding would decide between a side and the inside. Every point of it is close to one of its sides.
  if (!m.corner && glm::dot(n, n) <= degenerate_sine2 * glm::dot(ab, ab) * glm::dot(ac, ac))
    return nearer(nearer(at(m.along_ab, 0, false), at(0, m.along_ac, false)), at(1 - m.along_bc, m.along_bc, false));
  return at(m.v, m.w, m.inner);
}

Closest closest_edges(const glm::vec3& p, const glm::vec3& q, const glm::vec3& r, const glm::vec3& s) {
  const glm::vec3 d1 = q - p, d2 = s - r, between = p - r;
  const EdgeParameters m = edge_parameters(glm::dot(d1, d1), glm::dot(d1, d2), glm::dot(d1, between), glm::dot(d2, d2),
                                           glm::dot(d2, between));
  const glm::vec3 separation = between + m.s * d1 - m.t * d2;
  return {{1 - m.s, m.s, 1 - m.t, m.t}, separation, m.inner};
}

}  // namespace collide::surface
