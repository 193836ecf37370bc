#pragma once
// The innermost loop of every method: which vertices of two runs are closer than the tolerance (§2.3).

#include "collide/aabb.h"
#include "collide/points.h"

namespace collide {

struct SlotPair {
  Index a, b;
};

/// Appends every pair of slots i < j, i from a and j from b, with squared_distance < tolerance2. Picks the widest
/// instructions of the processor; the result is the same on all of them.
void near_pairs(const Points& points, Range a, Range b, float tolerance2, std::vector<SlotPair>& hits);

/// The same where all of b lies inside the region: vertices of a that are not within reach of it (see contact_reach)
/// are passed over. Returns how many of a were not.
Index near_pairs(const Points& points, Range a, Range b, const Aabb& region, float reach, float tolerance2,
                 std::vector<SlotPair>& hits);

}  // namespace collide
