#pragma once
// The bodies that take part: shared by both parts of the oracle, surface_overlaps.cpp and surface_crossings.cpp.

#include <utility>

#include "collide/surface/box_tree.h"
#include "collide/surface/surface.h"

namespace collide::oracle {

/// Throws std::invalid_argument unless there is one surface for each body, null or with as many vertices as the body.
void require_match(const Frame& frame, const surface::Surfaces& surfaces);

/// Returns the box of a body's vertices; empty if there are none or one is not finite.
surface::Box box_of_body(const Frame& frame, Index body);

/// Returns the vertices of a triangle or an edge as numbers in the frame. local: their numbers in the body.
template <std::size_t N>
std::array<Index, N> to_frame(const Frame& frame, Index body, std::array<Index, N> local) {
  for (Index& vertex : local) vertex += frame.bodies->first[body];
  return local;
}

/// The broad phase: finds the bodies whose boxes overlap.
class BodyNeighbours {
 public:
  BodyNeighbours() = default;
  /// box: the box of each body. A body with an empty box has no neighbours.
  explicit BodyNeighbours(std::vector<surface::Box> box) : box_(std::move(box)), tree_(box_) {}
  const surface::Box& box(Index body) const { return box_[body]; }
  /// Calls take(other) for every body whose box overlaps that of `body`, including itself.
  template <class Take>
  void for_each(Index body, const Take& take) const {
    tree_.for_each_overlapping(box_[body], take);
  }

 private:
  std::vector<surface::Box> box_;
  surface::BoxTree tree_;
};

}  // namespace collide::oracle
