#pragma once
// First stage of every method: the bodies' bounding boxes (§2.1), and which bodies take part at all.

#include "collide/detector.h"

namespace collide {

struct Aabb {
  glm::vec3 lo, hi;  // m, closed
};

struct BodyBoxes {
  std::vector<Aabb> box;          // of every body; meaningless unless the body is live
  std::vector<Index> live;        // bodies with vertices, all of them finite; ascending
  std::vector<Index> non_finite;  // bodies with a NaN or infinite coordinate, ascending

  void build(const Frame& frame);
};

}  // namespace collide
