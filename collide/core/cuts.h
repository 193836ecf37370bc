#pragma once
// The midpoint cuts of one axis of a body's box (§2.1). The cuts run along x, y, z in turn, so each axis is halved by
// itself and a box is one interval of each axis.

#include <array>

#include "collide/core/aabb.h"

namespace collide {

/// How many of `levels` cuts fall on the axis: the first is along x, the second along y, the third along z, ...
constexpr int cuts_along(int axis, int levels) { return (levels + 2 - axis) / 3; }

/// The 2^depth intervals between border[0] = lo and border[2^depth] = hi, each border shared by both its sides.
struct Cuts {
  static constexpr int max_depth = 5;  // of max_levels cuts
  std::array<float, (1 << max_depth) + 1> border;
  int depth = 0;

  int intervals() const { return 1 << depth; }

  void build(float lo, float hi, int cuts) {
    depth = cuts;
    border[0] = lo;
    border[static_cast<std::size_t>(intervals())] = hi;
    for (int step = intervals(); step > 1; step /= 2) {
      for (int i = 0; i < intervals(); i += step) border[i + step / 2] = (border[i] + border[i + step]) / 2;
    }
  }

  /// The interval of a value: at every cut it goes up if value >= mid.
  int interval_of(float value) const {
    int interval = 0;
    for (int step = intervals() / 2; step > 0; step /= 2) interval += value >= border[interval + step] ? step : 0;
    return interval;
  }
};

/// The cuts of a body's box along x, y and z.
inline std::array<Cuts, 3> cuts_of(const Aabb& box, int levels) {
  std::array<Cuts, 3> cuts;
  for (int axis = 0; axis < 3; ++axis) {
    cuts[static_cast<std::size_t>(axis)].build(box.lo[axis], box.hi[axis], cuts_along(axis, levels));
  }
  return cuts;
}

}  // namespace collide
