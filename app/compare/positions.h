#pragma once
// A copy of the positions of all vertices.

#include <vector>

#include "collide/core/frame.h"

namespace app::compare {

/// World positions of all vertices, in metres.
struct Positions {
  std::vector<float> x, y, z;

  void copy(const collide::Frame& frame) {
    x.assign(frame.x.begin(), frame.x.end());
    y.assign(frame.y.begin(), frame.y.end());
    z.assign(frame.z.begin(), frame.z.end());
  }
};

}  // namespace app::compare
