#include "collide/surface/surface.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "collide/trees/patch_cut.h"

namespace collide::surface {

namespace {

constexpr Index none = std::numeric_limits<Index>::max();
constexpr std::size_t most_joined = std::size_t{1} << 27;  // those in one list count twice

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

  edge_triangles_.assign(edges_.size(), {none, none});
  for (Index t = 0; t < triangles_.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = triangles_[t][k], b = triangles_[t][(k + 1) % 3];
      const auto edge = std::lower_bound(edges_.begin(), edges_.end(), Edge{std::min(a, b), std::max(a, b)});
      auto& at = edge_triangles_[static_cast<std::size_t>(edge - edges_.begin())];
      at = {at[0] == none ? t : at[0], t};
    }
  }

  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  triangles_at_.resize(3 * triangles_.size());
  std::vector<Index> next(first_.begin(), first_.end() - 1);
  for (Index t = 0; t < triangles_.size(); ++t) {
    for (const Index vertex : triangles_[t]) triangles_at_[next[vertex]++] = t;
  }
}

JoinedPairs::JoinedPairs(const FeaturePatches& ones, const FeaturePatches& twos, Index vertices) {
  constexpr Index size = trees::patch_size;
  const auto for_corners = [](const std::array<Index, 3>& corners, const auto& visit) {
    for (std::size_t k = 0; k < corners.size(); ++k)
      if (k == 0 || corners[k] != corners[k - 1]) visit(corners[k]);
  };
  std::vector<std::vector<Index>> at(vertices);  // places in the second list
  for (Index j = 0; j < twos.size(); ++j) for_corners(twos.corners[j], [&](Index v) { at[v].push_back(j); });
  std::size_t pairs = 0;
  std::vector<Index> listed(twos.size() / size + std::size_t{1}, none);  // by its patch: which of `patches` it is
  for (Index begin = 0; begin < ones.size(); begin += size) {
    const auto add = [&](Index i, Index j) {
      Index& where = listed[j / size];
      if (where == none) {
        where = static_cast<Index>(patches.size());
        patches.push_back({j / size, {}});
      }
      patches[where].pairs[(i - begin) / 4] |= std::uint64_t{1} << ((i - begin) % 4 * size + j % size);
    };
    for (Index i = begin; i < std::min(begin + size, ones.size()); ++i) {
      for_corners(ones.corners[i], [&](Index v) {
        for (const Index j : at[v])
          if (&ones != &twos || j > i) add(i, j);
        pairs += at[v].size();
      });
      if (pairs > most_joined)
        throw std::length_error("a vertex has too many faces for contact of a surface with itself");
      for (Index j = begin; j <= i && &ones == &twos; ++j) add(i, j);
    }
    const auto run = patches.begin() + first.back();
    for (auto it = run; it != patches.end(); ++it) listed[it->other] = none;
    std::sort(run, patches.end(), [](const Patch& a, const Patch& b) { return a.other < b.other; });
    first.push_back(static_cast<Index>(patches.size()));
  }
}

const SurfacePatches& Surface::patches(const VertexRun& at) const {
  const auto cut = [&](FeaturePatches& patches, std::size_t count, const auto& corners_of) {
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
  std::call_once(cut_->patched, [&] {
    auto& [vertices, faces, edges] = cut_->patches;
    cut(vertices, vertex_count_, [](Index v) { return Triangle{v, v, v}; });
    cut(faces, triangles_.size(), [&](Index t) { return triangles_[t]; });
    cut(edges, edges_.size(), [&](Index e) { return Triangle{edges_[e][0], edges_[e][1], edges_[e][1]}; });
  });
  return cut_->patches;
}

const SurfaceJoints& Surface::joints(const VertexRun& at) const {
  std::call_once(cut_->joined, [&] {
    const auto& [vertices, faces, edges] = patches(at);
    cut_->joints = {{vertices, faces, vertex_count_}, {edges, edges, vertex_count_}};
  });
  return cut_->joints;
}

}  // namespace collide::surface
