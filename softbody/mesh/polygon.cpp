#include "softbody/mesh/polygon.h"

#include <algorithm>
#include <cassert>
#include <compare>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numeric>
#include <queue>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace softbody {
namespace {

/// Returns the corners projected along the polygon's mean normal (Newell's), counter-clockwise.
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

/// Returns twice the area of a, b, c; positive if they are counter-clockwise.
double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Returns true if a triangle of the corners that are left is an ear: it turns to the left and holds none of the
/// others.
bool is_ear(const Triangle& t, const std::vector<Index>& left, const std::vector<glm::dvec2>& flat) {
  const glm::dvec2 &a = flat[t[0]], &b = flat[t[1]], &c = flat[t[2]];
  if (turn(a, b, c) <= 0) return false;
  return std::ranges::none_of(left, [&](Index other) {
    const glm::dvec2& p = flat[other];
    return p != a && p != b && p != c && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
  });
}

/// Cost of a triangulation. A smaller cost is better.
struct Cost {
  double price = 0, length = 0;  // length: sum of the squares of the cuts' lengths
  Cost operator+(const Cost& other) const { return {price + other.price, length + other.length}; }
  auto operator<=>(const Cost&) const = default;
};

/// Returns the cheapest of all triangulations of a polygon, by dynamic programming (Klincsek 1980). cut_price(i, j):
/// price of the cut between corners i < j; triangle_price(i, k, j): price of the triangle of corners i < k < j.
std::vector<Triangle> cheapest_triangles(std::span<const glm::dvec3> corners, const auto& cut_price,
                                         const auto& triangle_price) {
  const std::size_t n = corners.size();
  struct Part {
    Cost cost;
    std::size_t apex = 0;
  };
  std::vector<Part> parts(n * n);  // [i * n + j] and [j * n + i]: what lies between corners i and j, and their cut
  for (std::size_t span = 2; span < n; ++span)
    for (std::size_t i = 0, j = span; j < n; ++i, ++j) {
      Part best{{std::numeric_limits<double>::infinity(), 0}};
      for (std::size_t k = i + 1; k < j; ++k) {
        const Cost cost = parts[i * n + k].cost + parts[j * n + k].cost + Cost{triangle_price(i, k, j), 0};
        if (cost < best.cost) best = {cost, k};
      }
      const glm::dvec3 cut = corners[j] - corners[i];
      if (span + 1 < n) best.cost = best.cost + Cost{cut_price(i, j), glm::dot(cut, cut)};
      parts[i * n + j] = parts[j * n + i] = best;
    }
  std::vector<Triangle> triangles;
  std::vector<std::pair<std::size_t, std::size_t>> left{{0, n - 1}};
  while (!left.empty()) {
    const auto [i, j] = left.back();
    left.pop_back();
    if (j - i < 2) continue;
    const std::size_t k = parts[i * n + j].apex;
    triangles.push_back({static_cast<Index>(i), static_cast<Index>(k), static_cast<Index>(j)});
    left.insert(left.end(), {{i, k}, {k, j}});
  }
  return triangles;
}

bool is_degenerate(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// Assigns cuts to polygons by an auction (Bertsekas 1979). A polygon whose cuts are taken takes the cheapest ones
/// instead, if necessary from other polygons, and raises their price. A polygon that has lost a cut chooses again.
class Auction {
 public:
  Auction(const Polygons& polygons, std::span<const glm::dvec3> vertices)
      : polygons_(polygons), vertices_(vertices), triangles_(polygons.corners.size() - 2 * polygons.size()) {
    for (std::size_t p = 0; p < polygons.size(); ++p)
      for (const Edge& side : sides_of(p)) sides_.push_back(side);
    std::sort(sides_.begin(), sides_.end());
  }

  Triangulation run() {
    for (std::size_t p = 0; p < polygons_.size(); ++p) {
      set_triangles(p, triangulate(outline(p)));
      if (!take_free_cuts(p)) waiting_.push(p);
    }
    while (!waiting_.empty()) {
      const std::size_t p = waiting_.front();
      waiting_.pop();
      bid(p);
    }
    return result();
  }

 private:
  static constexpr std::size_t nobody = ~std::size_t{0};
  static constexpr double side_price = 1e9;  // more than any sum of others
  static constexpr double fold_price = 8;    // a triangle that is turned over or flat: rather than so many lost cuts
  static constexpr std::size_t max_work = std::size_t{1} << 31;  // of all bids, some seconds

  struct Cut {
    std::size_t owner = nobody;
    double price = 0;
  };

  std::span<Triangle> triangles_of(std::size_t p) {
    const std::size_t count = polygons_[p].size() - 2;
    return std::span(triangles_).subspan(polygons_.ends[p] - 2 * (p + 1) - count, count);
  }

  std::vector<glm::dvec3> outline(std::size_t p) const {
    std::vector<glm::dvec3> corners;
    for (const Index v : polygons_[p]) corners.push_back(vertices_[v]);
    return corners;
  }

  void set_triangles(std::size_t p, const std::vector<Triangle>& by_corner) {
    const std::span<const Index> polygon = polygons_[p];
    std::ranges::transform(by_corner, triangles_of(p).begin(), [&](const Triangle& t) -> Triangle {
      return {polygon[t[0]], polygon[t[1]], polygon[t[2]]};
    });
  }

  std::vector<Edge> sides_of(std::size_t p) const {
    const std::span<const Index> polygon = polygons_[p];
    std::vector<Edge> sides;
    for (std::size_t i = 0; i < polygon.size(); ++i)
      sides.push_back(ordered(polygon[i], polygon[(i + 1) % polygon.size()]));
    return sides;
  }

  /// Returns the edges of a polygon's triangles that are not sides of the polygon, ascending, once for each triangle. A
  /// cut beside a degenerate triangle that takes the place of a side is not among them.
  std::vector<Edge> cuts_of(std::size_t p) {
    if (polygons_[p].size() == 3) return {};
    std::vector<Edge> edges, sides = sides_of(p), cuts;
    for (const Triangle& t : triangles_of(p))
      for (std::size_t k = 0; k < 3 && !is_degenerate(t); ++k) edges.push_back(ordered(t[k], t[(k + 1) % 3]));
    std::sort(edges.begin(), edges.end());
    std::sort(sides.begin(), sides.end());
    std::set_difference(edges.begin(), edges.end(), sides.begin(), sides.end(), std::back_inserter(cuts));
    return cuts;
  }

  static std::uint64_t key(const Edge& edge) { return std::uint64_t{edge[0]} << 32 | edge[1]; }
  bool is_side(const Edge& edge) const { return std::binary_search(sides_.begin(), sides_.end(), edge); }

  /// True if two cuts are the same edge, as can happen if the outline returns to a vertex.
  static bool meet(const std::vector<Edge>& cuts, std::size_t i) { return i >= 2 && cuts[i] == cuts[i - 2]; }

  bool take_free_cuts(std::size_t p) {
    const std::vector<Edge> cuts = cuts_of(p);
    for (std::size_t i = 0; i < cuts.size(); ++i)
      if (is_side(cuts[i]) || cuts_.contains(key(cuts[i])) || meet(cuts, i)) return false;
    for (const Edge& cut : cuts) cuts_[key(cut)].owner = p;
    return true;
  }

  double price_of(const Edge& cut) const {
    if (cut[0] == cut[1]) return 0;
    if (is_side(cut)) return side_price;
    const auto known = cuts_.find(key(cut));
    if (known == cuts_.end()) return 0;
    return known->second.price + (known->second.owner == nobody ? 0 : 1);
  }

  void bid(std::size_t p) {
    const std::span<const Index> polygon = polygons_[p];
    const std::size_t n = polygon.size();
    if ((work_ += n * n * n + 1000) > max_work) throw PolygonError(p);
    bidders_.insert(p);
    const std::vector<glm::dvec3> corners = outline(p);
    const std::vector<glm::dvec2> flat = flattened(corners);
    const auto cut_price = [&](std::size_t i, std::size_t j) { return price_of(ordered(polygon[i], polygon[j])); };
    const auto triangle_price = [&](std::size_t i, std::size_t k, std::size_t j) {
      const Triangle t{polygon[i], polygon[k], polygon[j]};
      // Two sides of a degenerate triangle are the same edge, which counts once less without the triangle.
      if (is_degenerate(t)) return -price_of(ordered(t[0], t[0] == t[1] ? t[2] : t[1]));
      return turn(flat[i], flat[k], flat[j]) <= 0 ? fold_price : 0;
    };
    set_triangles(p, cheapest_triangles(corners, cut_price, triangle_price));
    const std::vector<Edge> cuts = cuts_of(p);
    bool alone = true;
    for (std::size_t i = 0; i < cuts.size(); ++i) {
      if (is_side(cuts[i])) throw PolygonError(p);
      alone = alone && !meet(cuts, i);
      Cut& taken = cuts_[key(cuts[i])];
      if (taken.owner != nobody && taken.owner != p) give_up_cuts(taken.owner);
      taken.owner = p;
      // Whoever wants a cut finds a free one by a chain of bidders, if there is one, in which prices differ by less
      // than two folds from each to the next.
      if (++taken.price > 2 * fold_price * double(bidders_.size())) throw PolygonError(p);
    }
    if (!alone) give_up_cuts(p);
  }

  void give_up_cuts(std::size_t p) {
    for (const Edge& cut : cuts_of(p)) cuts_[key(cut)].owner = nobody;
    waiting_.push(p);
  }

  Triangulation result() {
    Triangulation cut;
    for (std::size_t p = 0; p < polygons_.size(); ++p)
      for (const Triangle& t : triangles_of(p)) {
        if (is_degenerate(t)) continue;
        cut.triangles.push_back(t);
        cut.polygon.push_back(static_cast<Index>(p));
      }
    return cut;
  }

  const Polygons& polygons_;
  std::span<const glm::dvec3> vertices_;
  std::vector<Triangle> triangles_;  // by vertex, two fewer than corners of each polygon
  std::vector<Edge> sides_;          // of all polygons, ascending
  std::unordered_map<std::uint64_t, Cut> cuts_;
  std::queue<std::size_t> waiting_;  // polygons whose cuts are not theirs
  std::unordered_set<std::size_t> bidders_;
  std::size_t work_ = 0;
};

}  // namespace

std::vector<Triangle> triangulate(std::span<const glm::dvec3> corners) {
  assert(corners.size() >= 3);
  if (corners.size() == 3) return {{0, 1, 2}};
  const std::vector<glm::dvec2> flat = flattened(corners);
  std::vector<Index> left(corners.size());
  std::iota(left.begin(), left.end(), Index{0});
  const auto at = [&left](std::size_t k) -> Triangle {
    return {left[(k + left.size() - 1) % left.size()], left[k], left[(k + 1) % left.size()]};
  };
  std::vector<Triangle> triangles;
  while (left.size() > 3) {
    std::size_t best = 0;  // the ear with the shortest cut, or any corner if there is no ear
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < left.size(); ++k) {
      const Triangle t = at(k);
      const glm::dvec2 cut = flat[t[2]] - flat[t[0]];
      if (glm::dot(cut, cut) >= shortest || !is_ear(t, left, flat)) continue;
      best = k;
      shortest = glm::dot(cut, cut);
    }
    triangles.push_back(at(best));
    left.erase(left.begin() + std::ptrdiff_t(best));
  }
  triangles.push_back(at(1));
  return triangles;
}

Triangulation triangulate(const Polygons& polygons, std::span<const glm::dvec3> vertices) {
  return Auction(polygons, vertices).run();
}

}  // namespace softbody
