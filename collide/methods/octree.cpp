// An octree over all vertices, built anew in every frame: each node is shrunk to the box of its vertices and cut across
// the middle of its sides. Sides shorter than half of the longest one stay whole, so that nodes become cubes.

#include <algorithm>

#include "collide/methods/detectors.h"
#include "collide/methods/vertex_tree.h"

namespace collide::methods {

namespace {

using trees::Item;

/// Where the sides of a node are cut: values above `middle` belong to the upper half.
struct Middles {
  std::array<float, 3> middle;

  explicit Middles(const Aabb& box) {
    const glm::vec3 half = box.hi * 0.5f - box.lo * 0.5f;
    const float longest = std::max({half.x, half.y, half.z});
    for (int axis = 0; axis < 3; ++axis) {
      const float lo = box.lo[axis], hi = box.hi[axis], mid = lo * 0.5f + hi * 0.5f;
      const bool whole = half[axis] < longest / 2;
      middle[static_cast<std::size_t>(axis)] = whole ? hi : mid < hi ? mid : lo;  // neither half of two floats is empty
    }
  }

  std::size_t octant(const Item& item) const {
    return std::size_t{item.at[0] > middle[0]} | std::size_t{item.at[1] > middle[1]} << 1 |
           std::size_t{item.at[2] > middle[2]} << 2;
  }
};

/// A counting sort by octant.
trees::Parts cut_into_octants(std::span<const Item> items, const Aabb& box, Item* to) {
  const Middles middles(box);
  std::array<Index, 8> size{}, next{};
  for (const Item& item : items) ++size[middles.octant(item)];
  trees::Parts parts;
  Index end = 0;
  for (std::size_t octant = 0; octant < size.size(); ++octant) {
    next[octant] = end;
    end += size[octant];
    if (size[octant] > 0) parts.size[parts.count++] = size[octant];
  }
  if (parts.count == 1) return {};  // all in one place
  for (const Item& item : items) to[next[middles.octant(item)]++] = item;
  return parts;
}

}  // namespace

std::unique_ptr<Detector> make_octree() { return std::make_unique<VertexTree>(cut_into_octants); }

}  // namespace collide::methods
