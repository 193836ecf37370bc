#include "collide/surface/surface.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "collide/trees/patch_cut.h"

namespace collide::surface {

namespace {

constexpr Index no_triangle = std::numeric_limits<Index>::max();

}  // namespace

Surface::Surface(Index vertex_count, std::vector<Triangle> triangles)
    : vertex_count_(vertex_count), triangles_(std::move(triangles)), first_(vertex_count + std::size_t{1}, 0) {
  std::vector<Edge> up, down;  // sides from the smaller to the greater vertex; the other sides, reversed
  for (const Triangle& triangle : triangles_) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = triangle[k], b = triangle[(k + 1) % 3];
      if (a >= vertex_count) throw std::invalid_argument("Surface: a triangle names a missing vertex");
      if (a == b) throw std::invalid_argument("Surface: a triangle names a vertex twice");
      (a < b ? up : down).push_back({std::min(a, b), std::max(a, b)});
      ++first_[a + std::size_t{1}];
    }
  }
  std::sort(up.begin(), up.end());
  std::sort(down.begin(), down.end());
  closed_ = !triangles_.empty() && up == down;
  std::set_union(up.begin(), up.end(), down.begin(), down.end(), std::back_inserter(edges_));
  edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());

  edge_triangles_.assign(edges_.size(), {no_triangle, no_triangle});
  for (Index t = 0; t < triangles_.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = triangles_[t][k], b = triangles_[t][(k + 1) % 3];
      const auto edge = std::lower_bound(edges_.begin(), edges_.end(), Edge{std::min(a, b), std::max(a, b)});
      auto& at = edge_triangles_[static_cast<std::size_t>(edge - edges_.begin())];
      at = {at[0] == no_triangle ? t : at[0], t};
    }
  }

  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  triangles_at_.resize(3 * triangles_.size());
  std::vector<Index> next(first_.begin(), first_.end() - 1);
  for (Index t = 0; t < triangles_.size(); ++t) {
    for (const Index vertex : triangles_[t]) triangles_at_[next[vertex]++] = t;
  }
}

const SurfacePatches& Surface::patches(const VertexRun& at) const {
  const auto cut = [&](std::size_t count, const auto& corners_of, FeaturePatches& patches) {
    std::vector<trees::Item> items;
    for (Index i = 0; i < count; ++i) {
      const Triangle c = corners_of(i);
      const glm::vec3 middle = at[c[0]] / 3.0f + at[c[1]] / 3.0f + at[c[2]] / 3.0f;
      items.push_back({{middle.x, middle.y, middle.z}, i});
    }
    trees::cut_into_patches(items);
    for (const trees::Item& item : items) {
      patches.feature.push_back(item.number);
      patches.corners.push_back(corners_of(item.number));
    }
  };
  std::call_once(cut_->once, [&] {
    auto& [vertices, faces, edges] = cut_->patches;
    cut(
        vertex_count_,
        [](Index v) {
          return Triangle{v, v, v};
        },
        vertices);
    cut(
        triangles_.size(), [&](Index t) { return triangles_[t]; }, faces);
    cut(
        edges_.size(),
        [&](Index e) {
          return Triangle{edges_[e][0], edges_[e][1], edges_[e][1]};
        },
        edges);
  });
  return cut_->patches;
}

}  // namespace collide::surface
