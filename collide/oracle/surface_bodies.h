#pragma once
// The bodies that take part: shared by both parts of the oracle, surface_overlaps.cpp and surface_crossings.cpp.

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

}  // namespace collide::oracle
