#pragma once
// The inner loops of every method but the exact one: the pairs of vertices of two runs that are closer than the
// tolerance (§2.3). Vectorised with Highway; the result is the same on every instruction set.

#include "collide/core/points.h"

namespace collide {

struct SlotPair {
  Index a, b;
};

/// Appends every pair of slots i < j, i from a and j from b, with squared_distance < tolerance2.
void near_pairs(const Points& points, Range a, Range b, float tolerance2, std::vector<SlotPair>& hits);

/// Appends every pair of a slot of a and a slot of one of many short runs, which do not overlap a.
void near_pairs(const Points& points, Range a, std::span<const Range> runs, float tolerance2,
                std::vector<SlotPair>& hits);

}  // namespace collide
