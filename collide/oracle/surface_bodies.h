#pragma once
// What the oracle's two questions (surface_overlaps.cpp, surface_crossings.cpp) share: the bodies that take part.

#include "collide/surface/box_tree.h"
#include "collide/surface/surface.h"

namespace collide::oracle {

inline glm::vec3 position(const Frame& frame, Index vertex) {
  return {frame.x[vertex], frame.y[vertex], frame.z[vertex]};
}

/// The body of a vertex of the frame.
Index body_of(const Bodies& bodies, Index vertex);

/// Throws std::invalid_argument unless the surfaces are those of the frame's bodies.
void require_match(const Frame& frame, const surface::Surfaces& surfaces);

/// The box of a body's vertices; empty if there are none or if one is not finite.
surface::Box box_of_body(const Frame& frame, Index body);

/// Corners of a body's triangle or ends of its edge: vertices over the frame.
template <std::size_t N>
std::array<Index, N> over_frame(const Frame& frame, Index body, std::array<Index, N> local) {
  for (Index& vertex : local) vertex += frame.bodies->first[body];
  return local;
}

/// Bodies whose boxes overlap.
class BodyNeighbours {
 public:
  BodyNeighbours() = default;
  /// box: of each body; no neighbours where it is empty.
  explicit BodyNeighbours(std::vector<surface::Box> box) : box_(std::move(box)), tree_(box_) {}
  const surface::Box& box(Index body) const { return box_[body]; }
  /// Calls take(other) for every body whose box overlaps this one's, the body itself included.
  template <class Take>
  void each(Index body, const Take& take) const {
    tree_.for_each_overlapping(box_[body], take);
  }

 private:
  std::vector<surface::Box> box_;
  surface::BoxTree tree_;
};

}  // namespace collide::oracle
