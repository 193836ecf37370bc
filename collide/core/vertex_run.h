#pragma once
// The vertices of one body, as the vector loops take them.

#include "collide/core/frame.h"

namespace collide {

/// Some vertices of one body.
struct Run {
  const float *x, *y, *z;
  Index size;  // > 0
};

/// As many values as one instruction takes, at most: arrays that vector loops read go on for so many.
inline constexpr Index most_lanes = 16;

}  // namespace collide
