#pragma once
// A tree of bounding boxes over whatever has a box: faces, edges, bodies.

#include <algorithm>
#include <limits>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "collide/core/frame.h"

namespace collide::surface {

/// A closed box in doubles, so that float positions and their sums and differences need no care. Empty at first.
struct Box {
  glm::dvec3 lo{std::numeric_limits<double>::infinity()}, hi{-std::numeric_limits<double>::infinity()};

  bool empty() const { return !(lo.x <= hi.x); }
  void add(const glm::dvec3& point) {
    lo = glm::min(lo, point);
    hi = glm::max(hi, point);
  }
  void add(const Box& box) {
    lo = glm::min(lo, box.lo);
    hi = glm::max(hi, box.hi);
  }
};
inline bool overlap(const Box& a, const Box& b) {
  return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y && a.lo.z <= b.hi.z &&
         b.lo.z <= a.hi.z;
}
/// m^2, from a point to the nearest point of a box; 0 inside.
inline double squared_distance_to(const Box& box, const glm::dvec3& p) {
  const glm::dvec3 outside = glm::max(glm::max(box.lo - p, p - box.hi), 0.0);
  return glm::dot(outside, outside);
}

/// Split at medians along the widest axis, one item a leaf, nodes in the order of a walk, so that it needs no stack.
class BoxTree {
 public:
  BoxTree() = default;
  /// The box of item i is boxes[i]; items whose box is empty are left out.
  explicit BoxTree(const std::vector<Box>& boxes);

  /// Calls take(item) for every item whose box, and the boxes of all nodes above it, enter(box) says true to.
  template <class Enter, class Take>
  void walk(const Enter& enter, const Take& take) const {
    for (Index i = 0; i < nodes_.size();) {
      const Node& node = nodes_[i];
      if (!enter(node.box)) {
        i = node.end;
      } else {
        ++i;
        if (node.end == i) take(node.item);
      }
    }
  }
  /// Calls take(item) for every item whose box overlaps this one.
  template <class Take>
  void overlapping(const Box& box, const Take& take) const {
    walk([&](const Box& other) { return overlap(box, other); }, take);
  }
  /// Around all items.
  Box box() const { return nodes_.empty() ? Box{} : nodes_.front().box; }

 private:
  struct Node {
    Box box;
    Index end;   // of the nodes below this one
    Index item;  // of a leaf
  };
  using Place = std::vector<Index>::iterator;
  void build(const std::vector<Box>& boxes, Place begin, Place end);

  std::vector<Node> nodes_;
};

}  // namespace collide::surface
