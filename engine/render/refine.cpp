#include "engine/render/refine.h"

#include <algorithm>
#include <map>
#include <utility>

namespace engine {
namespace {

class Refiner {
 public:
  Refiner(std::uint32_t vertex_count, int cuts) : cuts_(cuts) {
    for (std::uint32_t v = 0; v < vertex_count; ++v) mesh_.vertices.push_back({{v, v, v}, {1.0f, 0.0f}});
  }

  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto at = [&](int i, int j) { return point({a, b, c}, {cuts_ - i - j, i, j}); };
    for (int i = 0; i < cuts_; ++i) {
      for (int j = 0; i + j < cuts_; ++j) {
        mesh_.indices.insert(mesh_.indices.end(), {at(i, j), at(i + 1, j), at(i, j + 1)});
        if (i + j + 1 == cuts_) continue;  // the last triangle of a row has no upside-down neighbour
        mesh_.indices.insert(mesh_.indices.end(), {at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }

  RefinedMesh take() { return std::move(mesh_); }

 private:
  struct Share {
    std::uint32_t corner;
    int parts;  // of cuts_
    auto operator<=>(const Share&) const = default;
  };
  using Point = std::array<Share, 3>;

  std::uint32_t point(const std::array<std::uint32_t, 3>& corners, const std::array<int, 3>& parts) {
    Point key;
    for (std::size_t k = 0; k < 3; ++k) key[k] = {corners[k], parts[k]};
    std::ranges::sort(key);
    // Corners without a share take the name of one that has, so that an edge's points are the same from both sides.
    const Share heaviest = *std::ranges::max_element(key, {}, &Share::parts);
    if (heaviest.parts == cuts_) return heaviest.corner;
    for (Share& share : key) {
      if (share.parts == 0) share.corner = heaviest.corner;
    }
    std::ranges::sort(key);
    const auto [found, added] = known_.try_emplace(key, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (added) mesh_.vertices.push_back(vertex(key));
    return found->second;
  }

  // The shader takes two equal first corners for a vertex of the mesh, so the corner named twice goes to the ends.
  RefinedVertex vertex(Point key) const {
    if (key[0].corner == key[1].corner) std::swap(key[1], key[2]);
    const auto weight = [&](const Share& share) { return static_cast<float>(share.parts) / static_cast<float>(cuts_); };
    return {{key[0].corner, key[1].corner, key[2].corner}, {weight(key[0]), weight(key[1])}};
  }

  int cuts_;
  RefinedMesh mesh_;
  std::map<Point, std::uint32_t> known_;
};

}  // namespace

RefinedMesh refine(std::span<const std::uint32_t> triangles, std::uint32_t vertex_count, int cuts) {
  Refiner refiner(vertex_count, cuts);
  for (std::size_t t = 0; t + 2 < triangles.size(); t += 3)
    refiner.add(triangles[t], triangles[t + 1], triangles[t + 2]);
  return refiner.take();
}

bool is_closed(std::span<const std::uint32_t> triangles) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
    if (next < triangles.size()) ++edges[{triangles[i], triangles[next]}];
  }
  return !edges.empty() && std::ranges::all_of(edges, [&](const auto& edge) {
    const auto opposite = edges.find({edge.first.second, edge.first.first});
    return edge.second == 1 && opposite != edges.end() && opposite->second == 1;
  });
}

}  // namespace engine
