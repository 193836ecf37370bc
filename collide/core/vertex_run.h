#pragma once
// The vertices of one body, in the form that the vectorised loops read.

#include "collide/core/frame.h"

namespace collide {

/// Consecutive vertices of one body: coordinates in metres.
struct VertexRun {
  const float *x, *y, *z;
  Index size;  // > 0

  glm::vec3 operator[](std::size_t vertex) const { return {x[vertex], y[vertex], z[vertex]}; }
};

/// Returns the vertices of a body, which must have some.
inline VertexRun vertices_of(const Frame& frame, Index body) {
  const Index first = frame.bodies->first[body];
  return {frame.x.data() + first, frame.y.data() + first, frame.z.data() + first, frame.bodies->size(body)};
}

/// The most values that one vector instruction takes. Arrays that vectorised loops read are padded by this many.
inline constexpr Index max_lanes = 16;

/// Boxes in columns (m). One that is NaN overlaps nothing.
struct BoxColumns {
  std::array<std::vector<float>, 3> lo, hi;
  void resize(std::size_t boxes) {
    for (auto* bounds : {&lo, &hi})
      for (std::vector<float>& values : *bounds) values.resize(boxes + max_lanes);
  }
};

}  // namespace collide
