#include "collide/closest_features.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace collide {

namespace {

constexpr float slight = 1e-6f;  // squared sine of an angle below which a face is a line, and edges are parallel

const Closest& nearer(const Closest& a, const Closest& b) {
  return glm::dot(b.apart, b.apart) < glm::dot(a.apart, a.apart) ? b : a;
}

}  // namespace

Closest closest_vertex_face(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const auto at = [&](float v, float w, bool inner) -> Closest {
    const float u = 1 - v - w;
    return {{1, u, v, w}, p - (u * a + v * b + w * c), inner};
  };
  const auto share = [](float part, float whole) { return whole > 0 ? std::clamp(part / whole, 0.0f, 1.0f) : 0.0f; };
  const glm::vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const float d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return at(0, 0, false);
  const float d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return at(1, 0, false);
  const float d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return at(0, 1, false);
  const auto on_ab = [&] { return at(share(d1, d1 - d3), 0, false); };
  const auto on_ac = [&] { return at(0, share(d2, d2 - d6), false); };
  const auto on_bc = [&] {
    const float w = share(d4 - d3, (d4 - d3) + (d5 - d6));
    return at(1 - w, w, false);
  };
  // In a sliver rounding decides between the sides and the inside: its sides are close enough to all of it.
  if (const glm::vec3 n = glm::cross(ab, ac); glm::dot(n, n) <= slight * glm::dot(ab, ab) * glm::dot(ac, ac))
    return nearer(nearer(on_ab(), on_ac()), on_bc());
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return on_ab();
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return on_ac();
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return on_bc();
  const float sum = va + vb + vc;
  return at(vb / sum, vc / sum, true);
}

Closest closest_edges(const glm::vec3& p, const glm::vec3& q, const glm::vec3& r, const glm::vec3& s) {
  const glm::vec3 d1 = q - p, d2 = s - r, between = p - r;
  const float a = glm::dot(d1, d1), e = glm::dot(d2, d2), f = glm::dot(d2, between), c = glm::dot(d1, between),
              b = glm::dot(d1, d2);
  const auto within = [](float part, float whole) { return whole > 0 ? std::clamp(part / whole, 0.0f, 1.0f) : 0.0f; };
  const float denominator = a * e - b * b;
  const bool parallel = denominator <= slight * a * e;
  float along = parallel ? 0.0f : std::clamp((b * f - c * e) / denominator, 0.0f, 1.0f);
  float across = within(b * along + f, e);
  along = within(b * across - c, a);
  const auto inside = [](float t) { return t > 0 && t < 1; };
  const glm::vec3 apart = between + along * d1 - across * d2;
  return {{1 - along, along, 1 - across, across}, apart, !parallel && inside(along) && inside(across)};
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
