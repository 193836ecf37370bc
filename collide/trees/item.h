#pragma once
// Vertices on their way into the leaves of a tree.

#include <algorithm>

#include <glm/common.hpp>

#include "collide/core/aabb.h"

namespace collide::trees {

struct Item {
  std::array<float, 3> at;  // m
  Index number;             // of the vertex, among those of the tree
};

/// Returns the box of the points at(begin) .. at(end - 1), of which there must be one.
template <class At>
Aabb bounds_of(std::size_t begin, std::size_t end, const At& at) {
  glm::vec3 lo = at(begin), hi = lo;
  for (std::size_t k = begin + 1; k < end; ++k) {
    const glm::vec3 p = at(k);
    lo = glm::min(lo, p);
    hi = glm::max(hi, p);
  }
  return {lo, hi};
}
inline Aabb bounds_of(std::span<const Item> items) {
  return bounds_of(0, items.size(),
                   [&](std::size_t k) { return glm::vec3(items[k].at[0], items[k].at[1], items[k].at[2]); });
}

/// Brings the items below the one that belongs to the place `middle` along the axis before it, and the others behind.
inline void part_at(std::span<Item> items, std::size_t middle, std::size_t axis) {
  std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(middle), items.end(),
                   [axis](const Item& a, const Item& b) { return a.at[axis] < b.at[axis]; });
}

}  // namespace collide::trees
