#pragma once
// A bounding volume hierarchy of boxes over items: faces, edges or bodies, at one instant or in motion.

#include <algorithm>
#include <cassert>
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
  static constexpr int axes = 3;
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
  double extent(int axis) const { return hi[axis] - lo[axis]; }
  double centre2(int axis) const { return lo[axis] + hi[axis]; }  // twice the centre
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

/// A box whose corners move along straight lines, from one place to another. It holds all points that do so and are
/// inside at both ends.
struct MovingBox {
  static constexpr int axes = 6;
  Box from, to;

  bool empty() const { return from.empty(); }
  void add(const glm::dvec3& point_from, const glm::dvec3& point_to) {
    from.add(point_from);
    to.add(point_to);
  }
  void add(const MovingBox& box) {
    from.add(box.from);
    to.add(box.to);
  }
  // Of the place at the beginning, then of the one at the end.
  double extent(int axis) const { return axis < 3 ? from.extent(axis) : to.extent(axis - 3); }
  double centre2(int axis) const { return axis < 3 ? from.centre2(axis) : to.centre2(axis - 3); }
};
/// Returns false if an axis separates the boxes, in the same order at both ends and therefore always. Nothing is
/// rounded.
inline bool overlap(const MovingBox& a, const MovingBox& b) {
  const auto before = [](const MovingBox& one, const MovingBox& other, int axis) {
    return one.from.hi[axis] < other.from.lo[axis] && one.to.hi[axis] < other.to.lo[axis];
  };
  for (int axis = 0; axis < 3; ++axis) {
    if (before(a, b, axis) || before(b, a, axis)) return false;
  }
  return true;
}

/// Splits at the median of the axis along which the boxes are spread widest and has one item in each leaf. The nodes
/// are stored in depth-first order, so that a walk needs no stack. Bounds: Box or MovingBox.
template <class Bounds>
class BoundsTree {
 public:
  BoundsTree() = default;
  /// Builds the tree. boxes[i] is the box of item i; items with an empty box are left out.
  explicit BoundsTree(const std::vector<Bounds>& boxes);

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
  void for_each_overlapping(const Bounds& box, const Take& take) const {
    walk([&](const Bounds& other) { return overlap(box, other); }, take);
  }
  struct Nearest {
    double distance;  // m
    Index item;
    auto operator<=>(const Nearest&) const = default;
  };
  /// Returns the item with the smallest distance(item) from a point; the first one if several are equally near.
  /// distance: how far what the box of the item holds is from the point, which floats may round; infinite if the item
  /// does not count. guess: an item; the nearer it is, the shorter is the search. Only for trees of Box, not empty.
  template <class Distance>
  Nearest nearest(const glm::dvec3& point, Index guess, const Distance& distance) const {
    assert(!nodes_.empty());
    Nearest best{distance(guess), guess};
    const auto may_be_nearer = [&](const Bounds& box) {
      return squared_distance_to(box, point) <= best.distance * best.distance * (1 + 1e-6);
    };
    walk(may_be_nearer, [&](Index item) { best = std::min(best, Nearest{distance(item), item}); });
    return best;
  }
  /// Returns the box around all items; empty if there are none.
  Bounds box() const { return nodes_.empty() ? Bounds{} : nodes_.front().box; }

 private:
  struct Node {
    Bounds box;
    Index end;   // one past the last node below this one
    Index item;  // only of a leaf
  };
  using Iterator = std::vector<Index>::iterator;
  void build(const std::vector<Bounds>& boxes, Iterator begin, Iterator end);

  std::vector<Node> nodes_;
};
using BoxTree = BoundsTree<Box>;
using MovingBoxTree = BoundsTree<MovingBox>;

}  // namespace collide::surface
