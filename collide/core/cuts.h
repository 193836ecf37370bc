#pragma once
// The midpoint cuts of a body's box (§2.1). The cuts run across x, y and z in turn, so each axis is halved on its own,
// and a subdivided box is one interval on each axis.

#include <array>

#include "collide/core/aabb.h"

namespace collide {

/// Returns how many of `levels` cuts halve the axis: the first cut halves x, the second y, the third z, and so on.
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

  /// Returns the interval of a value. A value on a cut belongs to the upper side.
  int interval_of(float value) const {
    int interval = 0;
    for (int step = intervals() / 2; step > 0; step /= 2) interval += value >= border[interval + step] ? step : 0;
    return interval;
  }
};

/// Returns the cuts of a body's box on the x, y and z axes.
inline std::array<Cuts, 3> cuts_of(const Aabb& box, int levels) {
  std::array<Cuts, 3> cuts;
  for (int axis = 0; axis < 3; ++axis) {
    cuts[static_cast<std::size_t>(axis)].build(box.lo[axis], box.hi[axis], cuts_along(axis, levels));
  }
  return cuts;
}

}  // namespace collide
