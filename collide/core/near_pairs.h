#pragma once
// The inner loops of every method but the exact one: the pairs of vertices of two runs that are closer than the
// tolerance (§2.3). Vectorised with Highway; the result is the same on every instruction set.

#include "collide/core/aabb.h"
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

/// Does the same for those slots of a that are near() a box around b, and returns how many these are. cutoff: m.
Index near_pairs(const Points& points, Range a, Range b, const Aabb& box_of_b, float cutoff, float tolerance2,
                 std::vector<SlotPair>& hits);

}  // namespace collide
