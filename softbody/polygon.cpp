#include "softbody/polygon.h"

#include <limits>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace softbody {
namespace {

/// The corners seen along the polygon's mean normal (Newell's), counter-clockwise.
std::vector<glm::dvec2> flattened(std::span<const glm::dvec3> corners) {
  glm::dvec3 normal(0.0);
  for (std::size_t i = 0; i < corners.size(); ++i)
    normal += glm::cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
  const glm::dvec3 size = glm::abs(normal);
  const int away = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  int u = (away + 1) % 3, v = (away + 2) % 3;
  if (normal[away] < 0) std::swap(u, v);
  std::vector<glm::dvec2> flat;
  for (const glm::dvec3& p : corners) flat.emplace_back(p[u], p[v]);
  return flat;
}

/// Twice the area of a, b, c; positive if they run counter-clockwise.
double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// What is left of a polygon while ears are clipped.
class Remainder {
 public:
  explicit Remainder(std::span<const glm::dvec3> corners) : flat_(flattened(corners)), left_(corners.size()) {
    std::iota(left_.begin(), left_.end(), Index{0});
  }
  std::size_t size() const { return left_.size(); }

  /// The triangle at place k, whose corner goes.
  Triangle clip(std::size_t k) {
    const Triangle t = at(k);
    left_.erase(left_.begin() + std::ptrdiff_t(k));
    return t;
  }

  /// The place of the ear with the shortest cut; any place if there is no ear.
  std::size_t best_ear() const {
    std::size_t best = 0;
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < left_.size(); ++k) {
      const auto [a, b, c] = at(k);
      const glm::dvec2 cut = flat_[c] - flat_[a];
      if (glm::dot(cut, cut) >= shortest || !is_ear(a, b, c)) continue;
      best = k;
      shortest = glm::dot(cut, cut);
    }
    return best;
  }

 private:
  Triangle at(std::size_t k) const {
    return {left_[(k + left_.size() - 1) % left_.size()], left_[k], left_[(k + 1) % left_.size()]};
  }

  bool is_ear(Index a, Index b, Index c) const {
    const glm::dvec2 &pa = flat_[a], &pb = flat_[b], &pc = flat_[c];
    if (turn(pa, pb, pc) <= 0) return false;
    for (const Index other : left_) {
      const glm::dvec2& p = flat_[other];
      if (p == pa || p == pb || p == pc) continue;
      if (turn(pa, pb, p) >= 0 && turn(pb, pc, p) >= 0 && turn(pc, pa, p) >= 0) return false;
    }
    return true;
  }

  std::vector<glm::dvec2> flat_;
  std::vector<Index> left_;
};

}  // namespace

std::vector<Triangle> triangulate(std::span<const glm::dvec3> corners) {
  if (corners.size() == 3) return {{0, 1, 2}};
  Remainder rest(corners);
  std::vector<Triangle> triangles;
  while (rest.size() > 3) triangles.push_back(rest.clip(rest.best_ear()));
  triangles.push_back(rest.clip(1));
  return triangles;
}

}  // namespace softbody
