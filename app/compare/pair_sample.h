#pragma once
// A sample of the pairs of vertices of a frame, to predict how many of them a grid brings together.

#include <vector>

#include <glm/vec3.hpp>

#include "collide/core/frame.h"

namespace app::compare {

class PairSample {
 public:
  /// Draws pairs: all of a small frame; of another one some thousands, the same ones each time. Pairs of one body count
  /// only with self_collision.
  void draw(const collide::Frame& frame, bool self_collision);

  /// Returns the share of all pairs that meet in a grid with these cells (m), wherever its origin is. Along each axis
  /// a vertex meets what lies within `reach` (m), and what a cell adds to this.
  double share(const glm::dvec3& cell, const glm::dvec3& reach) const;

 private:
  std::vector<glm::dvec3> apart_;  // m along each axis, of the pairs that count
  double drawn_ = 0;               // pairs, also those that do not count
};

}  // namespace app::compare
