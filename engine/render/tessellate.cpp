#include "engine/render/tessellate.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <map>
#include <utility>

namespace engine::render {
namespace {

class Tessellator {
 public:
  Tessellator(std::uint32_t vertex_count, int factor) : factor_(factor) {
    for (std::uint32_t v = 0; v < vertex_count; ++v) mesh_.vertices.push_back({{v, v, v}, {1.0f, 0.0f}});
  }

  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto at = [&](int i, int j) { return point({a, b, c}, {factor_ - i - j, i, j}); };
    for (int i = 0; i < factor_; ++i) {
      for (int j = 0; i + j < factor_; ++j) {
        mesh_.indices.insert(mesh_.indices.end(), {at(i, j), at(i + 1, j), at(i, j + 1)});
        if (i + j + 1 == factor_) continue;  // no upside-down triangle follows the last one of a row
        mesh_.indices.insert(mesh_.indices.end(), {at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }

  TessellatedMesh take() { return std::move(mesh_); }

 private:
  struct Share {
    std::uint32_t corner;
    int parts;  // of factor_
    auto operator<=>(const Share&) const = default;
  };
  using Point = std::array<Share, 3>;

  /// Returns the vertex index of a point; adds the vertex if it is new.
  std::uint32_t point(const std::array<std::uint32_t, 3>& corners, const std::array<int, 3>& parts) {
    Point key;
    for (std::size_t k = 0; k < 3; ++k) key[k] = {corners[k], parts[k]};
    std::ranges::sort(key);
    // A corner without a share is replaced by one with a share, so that both triangles at an edge form the same key.
    const Share largest = *std::ranges::max_element(key, {}, &Share::parts);
    if (largest.parts == factor_) return largest.corner;
    for (Share& share : key) {
      if (share.parts == 0) share.corner = largest.corner;
    }
    std::ranges::sort(key);
    const auto [found, added] = known_.try_emplace(key, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (added) mesh_.vertices.push_back(vertex(key));
    return found->second;
  }

  // The shader takes two equal first corners for a vertex of the mesh. So a corner that occurs twice becomes the first
  // and the last.
  TessellatedVertex vertex(Point key) const {
    if (key[0].corner == key[1].corner) std::swap(key[1], key[2]);
    const auto weight = [&](const Share& share) {
      return static_cast<float>(share.parts) / static_cast<float>(factor_);
    };
    return {{key[0].corner, key[1].corner, key[2].corner}, {weight(key[0]), weight(key[1])}};
  }

  int factor_;
  TessellatedMesh mesh_;
  std::map<Point, std::uint32_t> known_;
};

}  // namespace

TessellatedMesh tessellate(std::span<const std::uint32_t> triangles, std::uint32_t vertex_count, int factor) {
  assert(factor >= 1 && triangles.size() % 3 == 0);
  Tessellator tessellator(vertex_count, factor);
  for (std::size_t t = 0; t < triangles.size(); t += 3)
    tessellator.add_triangle(triangles[t], triangles[t + 1], triangles[t + 2]);
  return tessellator.take();
}

bool is_closed(std::span<const std::uint32_t> triangles) {
  assert(triangles.size() % 3 == 0);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;  // directed, with the number of their triangles
  for (std::size_t i = 0; i < triangles.size(); ++i) ++edges[{triangles[i], triangles[i % 3 == 2 ? i - 2 : i + 1]}];
  return !edges.empty() && std::ranges::all_of(edges, [&](const auto& edge) {
    const auto opposite = edges.find({edge.first.second, edge.first.first});
    return edge.second == 1 && opposite != edges.end() && opposite->second == 1;
  });
}

}  // namespace engine::render
