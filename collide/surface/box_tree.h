#pragma once
// A bounding volume hierarchy of boxes over items: faces, edges or bodies.

#include <algorithm>
#include <limits>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "collide/core/frame.h"

namespace collide::surface {

/// A closed box in doubles, which hold float positions, their sums and differences without harmful rounding. Empty at
/// first.
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
/// Returns the squared distance (m^2) of a point from a box; 0 inside.
inline double squared_distance_to(const Box& box, const glm::dvec3& p) {
  const glm::dvec3 outside = glm::max(glm::max(box.lo - p, p - box.hi), 0.0);
  return glm::dot(outside, outside);
}

/// Splits at the median of the widest axis and has one item in each leaf. The nodes are stored in depth-first order, so
/// that a walk needs no stack.
class BoxTree {
 public:
  BoxTree() = default;
  /// Builds the tree. boxes[i] is the box of item i; items with an empty box are left out.
  explicit BoxTree(const std::vector<Box>& boxes);

  /// Walks the tree depth first. Skips every node for whose box enter(box) is false, and calls take(item) for the items
  /// that are left.
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
  /// Calls take(item) for every item whose box overlaps `box`.
  template <class Take>
  void for_each_overlapping(const Box& box, const Take& take) const {
    walk([&](const Box& other) { return overlap(box, other); }, take);
  }
  /// Returns the box around all items; empty if there are none.
  Box box() const { return nodes_.empty() ? Box{} : nodes_.front().box; }

 private:
  struct Node {
    Box box;
    Index end;   // one past the last node below this one
    Index item;  // only of a leaf
  };
  using Iterator = std::vector<Index>::iterator;
  void build(const std::vector<Box>& boxes, Iterator begin, Iterator end);

  std::vector<Node> nodes_;
};

}  // namespace collide::surface
