#pragma once
// The cuts of the trees over an overlapped area: at midpoints as in §2.1, but always across the widest side.

#include "collide/core/aabb.h"

namespace collide {

struct MidpointCut {
  int axis;
  float mid;
};

inline MidpointCut cut_of(const Aabb& box) {
  const int axis = longest_axis(box.hi - box.lo);
  return {axis, box.lo[axis] * 0.5f + box.hi[axis] * 0.5f};
}

}  // namespace collide
