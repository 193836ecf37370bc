#pragma once
// Axis-aligned boxes, and which of them come near each other.

#include <algorithm>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "collide/core/frame.h"

namespace collide {

struct Aabb {
  glm::vec3 lo, hi;  // m, closed
  bool operator==(const Aabb&) const = default;
};

/// Returns the box around two boxes.
inline Aabb joint(const Aabb& a, const Aabb& b) { return {glm::min(a.lo, b.lo), glm::max(a.hi, b.hi)}; }

/// Returns the box of the points at(begin) .. at(end - 1), of which there must be one.
template <class At>
Aabb box_around(std::size_t begin, std::size_t end, const At& at) {
  assert(begin < end);
  glm::vec3 lo = at(begin), hi = lo;
  for (std::size_t k = begin + 1; k < end; ++k) {
    const glm::vec3 p = at(k);
    lo = glm::min(lo, p);
    hi = glm::max(hi, p);
  }
  return {lo, hi};
}

/// True unless the gap between the boxes exceeds the cutoff (m) along an axis. Rounding never hides a near pair:
/// subtraction rounds monotonically, and the cutoff is a float itself.
inline bool near(const Aabb& a, const Aabb& b, float cutoff) {
  return (a.lo.x - b.hi.x <= cutoff) & (b.lo.x - a.hi.x <= cutoff) &  // without mispredicted branches
         (a.lo.y - b.hi.y <= cutoff) & (b.lo.y - a.hi.y <= cutoff) &  //
         (a.lo.z - b.hi.z <= cutoff) & (b.lo.z - a.hi.z <= cutoff);
}

/// Returns the axis along which a side, or half of it, is longest.
inline int longest_axis(const glm::vec3& side) {
  return side.x >= side.y && side.x >= side.z ? 0 : side.y >= side.z ? 1 : 2;
}

/// Sweep and prune: calls meet(a, b) once for every two different items of `order` whose boxes box_of(a), box_of(b) are
/// near(). Sorts `order` along the axis on which the boxes are spread widest.
template <class BoxOf, class Meet>
void sweep(std::vector<Index>& order, float cutoff, const BoxOf& box_of, const Meet& meet) {
  if (order.size() < 2) return;
  const Aabb minima = box_around(0, order.size(), [&](std::size_t k) { return box_of(order[k]).lo; });
  const int axis = longest_axis(minima.hi - minima.lo);
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    const float x = box_of(a).lo[axis], y = box_of(b).lo[axis];
    return x != y ? x < y : a < b;
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Aabb& box = box_of(order[i]);
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const Aabb& other = box_of(order[j]);
      if (other.lo[axis] - box.hi[axis] > cutoff) break;
      if (near(box, other, cutoff)) meet(order[i], order[j]);
    }
  }
}

}  // namespace collide
