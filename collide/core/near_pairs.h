#pragma once
// The innermost loops of every method but the exact one: which vertices of two runs are closer than the tolerance
// (§2.3). In the processor's widest instructions; the result is the same on all of them.

#include "collide/core/points.h"

namespace collide {

struct SlotPair {
  Index a, b;
};

/// Appends every pair of slots i < j, i from a and j from b, with squared_distance < tolerance2.
void near_pairs(const Points& points, Range a, Range b, float tolerance2, std::vector<SlotPair>& hits);

/// The same for each of many short runs b that begin where a ends or later.
void near_pairs(const Points& points, Range a, std::span<const Range> runs, float tolerance2,
                std::vector<SlotPair>& hits);

}  // namespace collide
