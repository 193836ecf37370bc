#pragma once
// Vertices on their way into the leaves of a tree.

#include <algorithm>

#include "collide/core/aabb.h"

namespace collide::trees {

struct Item {
  std::array<float, 3> at;  // m
  Index number;             // of the vertex, among those of the tree
};

/// Returns the box of some items, of which there must be one.
inline Aabb bounds_of(std::span<const Item> items) {
  std::array<float, 3> lo = items.front().at, hi = lo;
  for (const Item& item : items) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lo[axis] = std::min(lo[axis], item.at[axis]);
      hi[axis] = std::max(hi[axis], item.at[axis]);
    }
  }
  return {{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}};
}

/// Brings the items below the one that belongs to the place `middle` along the axis before it, and the others behind.
inline void part_at(std::span<Item> items, std::size_t middle, std::size_t axis) {
  std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(middle), items.end(),
                   [axis](const Item& a, const Item& b) { return a.at[axis] < b.at[axis]; });
}

}  // namespace collide::trees
