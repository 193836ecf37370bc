#pragma once
// The inner loop over the vertices of two patches. Vectorised with Highway, which chooses the processor's instruction
// set at run time. Every instruction set finds the same contacts in the same order.

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

/// Writes the contacts between two patches of one body to `contacts`, which has room for all their pairs, and returns
/// how many there are. Leaves out what Shape::excludes() says. a and b are the same or do not overlap, and are of at
/// most max_lanes slots.
Index patch_contacts_within(const PatchPoints& points, Range a, Range b, float tolerance2, Contact* contacts);
/// Does the same for patches of two bodies; no pair is left out.
Index patch_contacts_between(const PatchPoints& points, Range a, Range b, float tolerance2, Contact* contacts);

}  // namespace collide::exact
