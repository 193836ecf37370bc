#include "collide/closest_features.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "collide/closest_shares.h"

namespace collide {

namespace {

const Closest& nearer(const Closest& a, const Closest& b) {
  return glm::dot(b.apart, b.apart) < glm::dot(a.apart, a.apart) ? b : a;
}

}  // namespace

Closest closest_vertex_face(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const auto at = [&](float v, float w, bool inner) -> Closest {
    const float u = 1 - v - w;
    return {{1, u, v, w}, p - (u * a + v * b + w * c), inner};
  };
  const glm::vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c, n = glm::cross(ab, ac);
  const FaceShares m = face_shares(glm::dot(ab, ap), glm::dot(ac, ap), glm::dot(ab, bp), glm::dot(ac, bp),
                                   glm::dot(ab, cp), glm::dot(ac, cp));
  // In a sliver rounding decides between the sides and the inside: its sides are close enough to all of it.
  if (!m.corner && glm::dot(n, n) <= slight * glm::dot(ab, ab) * glm::dot(ac, ac))
    return nearer(nearer(at(m.along_ab, 0, false), at(0, m.along_ac, false)), at(1 - m.along_bc, m.along_bc, false));
  return at(m.v, m.w, m.inner);
}

Closest closest_edges(const glm::vec3& p, const glm::vec3& q, const glm::vec3& r, const glm::vec3& s) {
  const glm::vec3 d1 = q - p, d2 = s - r, between = p - r;
  const EdgeShares m =
      edge_shares(glm::dot(d1, d1), glm::dot(d1, d2), glm::dot(d1, between), glm::dot(d2, d2), glm::dot(d2, between));
  const glm::vec3 apart = between + m.along * d1 - m.across * d2;
  return {{1 - m.along, m.along, 1 - m.across, m.across}, apart, m.inner};
}

bool inside(const glm::vec3& point, const Surface& surface, const Run& at) {
  const glm::dvec3 from(point), way(0.5377, 0.7141, 0.4486);  // along nothing that a mesh is likely to be aligned with
  bool odd = false;
  for (const Triangle& f : surface.triangles()) {
    glm::dvec3 corner[3];
    for (std::size_t k = 0; k < 3; ++k) corner[k] = glm::dvec3(at.x[f[k]], at.y[f[k]], at.z[f[k]]) - from;
    // Moeller and Trumbore (1997) by signed volumes: a side that two faces share is judged alike for both.
    const double u = glm::dot(way, glm::cross(corner[0], corner[1])),
                 v = glm::dot(way, glm::cross(corner[1], corner[2])),
                 w = glm::dot(way, glm::cross(corner[2], corner[0]));
    if ((u > 0) != (v > 0) || (v > 0) != (w > 0)) continue;
    const glm::dvec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double along = glm::dot(way, normal);
    if (along != 0 && glm::dot(corner[0], normal) / along > 0) odd = !odd;
  }
  return odd;
}

NearestFace nearest_face(const glm::vec3& point, const Surface& surface, const Run& at) {
  Index nearest = 0;
  float least = std::numeric_limits<float>::infinity();
  for (Index i = 0; i < surface.triangles().size(); ++i) {
    glm::vec3 corner[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const Index v = surface.triangles()[i][k];
      corner[k] = {at.x[v], at.y[v], at.z[v]};
    }
    const glm::vec3 apart = closest_vertex_face(point, corner[0], corner[1], corner[2]).apart;
    if (const float d2 = glm::dot(apart, apart); d2 < least) least = d2, nearest = i;
  }
  return {nearest, std::sqrt(least)};
}

}  // namespace collide
