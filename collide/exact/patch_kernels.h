#pragma once
// The inner loop over the vertices of two patches. Vectorised with Highway, which chooses the processor's instruction
// set at run time. Every instruction set finds the same contacts in the same order.

#include <algorithm>
#include <array>
#include <vector>

#include "collide/core/points.h"
#include "collide/core/result.h"

namespace collide::exact {

/// The vertices of patches now and, where the shape is known, at rest.
struct PatchPoints {
  const Points* now = nullptr;
  std::vector<float> rest_x, rest_y, rest_z;  // m, by slot; NaN where the rest shape is not known
  /// The slots that a mesh edge joins to each slot, where this alone keeps the pair from being a contact.
  std::vector<Index> joined, first_joined;
};

/// The boxes of some vertices now and at rest: their x, y and z, and a 0. Where a rest position is not known, the box
/// at rest is everything.
struct alignas(64) PatchBoxes {
  std::array<float, 4> lo, hi, rest_lo, rest_hi;
};

/// Returns what squared_distance() of two vertices in these boxes is at least, now. Each of its steps rounds
/// monotonically, so that this bound needs no margin.
inline float least_squared_distance(const PatchBoxes& a, const PatchBoxes& b) {
  std::array<float, 4> gap;
  for (std::size_t k = 0; k < 4; ++k) gap[k] = std::max(std::max(a.lo[k] - b.hi[k], b.lo[k] - a.hi[k]), 0.0f);
  for (float& side : gap) side *= side;
  return gap[0] + gap[1] + gap[2];
}
/// Returns what it is at most, at rest.
inline float greatest_squared_rest_distance(const PatchBoxes& a, const PatchBoxes& b) {
  std::array<float, 4> side;
  for (std::size_t k = 0; k < 4; ++k) side[k] = std::max(a.rest_hi[k] - b.rest_lo[k], b.rest_hi[k] - a.rest_lo[k]);
  for (float& length : side) length *= length;
  return side[0] + side[1] + side[2];
}

/// Writes the contacts between two patches of one body to `contacts`, which has room for all their pairs, and returns
/// how many there are. Leaves out what Shape::excludes() says. a and b are the same or do not overlap, and are of at
/// most max_lanes slots. box_of_b: around all of b.
Index patch_contacts_within(const PatchPoints& points, Range a, Range b, const PatchBoxes& box_of_b, float tolerance2,
                            Contact* contacts);
/// Does the same for patches of two bodies; no pair is left out.
Index patch_contacts_between(const PatchPoints& points, Range a, Range b, const PatchBoxes& box_of_b, float tolerance2,
                             Contact* contacts);

}  // namespace collide::exact
