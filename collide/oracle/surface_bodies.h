#pragma once
// The bodies that take part: shared by both files of the oracle, surface_overlaps.cpp and surface_oracle.cpp.

#include <cmath>
#include <stdexcept>

#include "collide/surface/box_tree.h"
#include "collide/surface/surface.h"

namespace collide::oracle {

/// Throws std::invalid_argument unless there is one surface for each body, null or with as many vertices as the body.
inline void require_match(const Frame& frame, const surface::Surfaces& surfaces) {
  const Bodies& bodies = *frame.bodies;
  if (surfaces.size() != bodies.count()) throw std::invalid_argument("surfaces: there must be one for each body");
  for (Index body = 0; body < bodies.count(); ++body) {
    if (surfaces[body] && surfaces[body]->vertex_count() != bodies.size(body)) {
      throw std::invalid_argument("surfaces: each must have as many vertices as its body");
    }
  }
}

/// Returns the box of a body's vertices; empty if there are none or one is not finite.
inline surface::Box box_of_body(const Frame& frame, Index body) {
  surface::Box box;
  for (Index v = frame.bodies->first[body]; v < frame.bodies->first[body + 1]; ++v) {
    const glm::vec3 p = position(frame, v);
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return {};
    box.add(glm::dvec3(p));
  }
  return box;
}

/// Returns the vertices of a triangle or an edge as numbers in the frame. local: their numbers in the body.
template <std::size_t N>
std::array<Index, N> to_frame(const Frame& frame, Index body, std::array<Index, N> local) {
  for (Index& vertex : local) vertex += frame.bodies->first[body];
  return local;
}

}  // namespace collide::oracle
