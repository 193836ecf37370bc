#pragma once
// The innermost loop of every method: which vertices of two runs are closer than the tolerance (§2.3).

#include "collide/points.h"

namespace collide {

struct SlotPair {
  Index a, b;
};

/// Appends every pair of slots i < j, i from a and j from b, with squared_distance < tolerance2. Picks the widest
/// instructions of the processor; the result is the same on all of them.
void near_pairs(const Places& places, Range a, Range b, float tolerance2, std::vector<SlotPair>& hits);

}  // namespace collide
