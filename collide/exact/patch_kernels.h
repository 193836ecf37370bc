#pragma once
// The inner loops over patches: runs of at most max_lanes slots of Points, with the boxes around them. Vectorised with
// Highway, which chooses the processor's instruction set at run time. Every instruction set finds the same contacts in
// the same order.

#include <array>
#include <vector>

#include "collide/core/points.h"
#include "collide/core/result.h"

namespace collide::exact {

/// The vertices of patches now and, where the shape is known, at rest. Arrays by patch go on for max_lanes values of no
/// meaning.
struct Patches {
  const Points* now = nullptr;
  std::vector<float> rest_x, rest_y, rest_z;  // m, by slot; NaN where the rest shape is not known
  /// The slots that a mesh edge joins to each slot, where this alone keeps the pair from being a contact.
  std::vector<Index> joined, first_joined;

  std::vector<Index> first_slot;                       // of each patch, and the end of the last one
  std::array<std::vector<float>, 3> lo, hi;            // m, of each patch: its box now
  std::array<std::vector<float>, 3> rest_lo, rest_hi;  // at rest; everything where that is not known

  Range slots(Index patch) const { return {first_slot[patch], first_slot[patch + std::size_t{1}]}; }
};

struct PatchContacts {
  Index contacts = 0;            // how many were written
  std::uint64_t pair_tests = 0;  // pairs of vertices in patches that are near each other
};

/// Writes the contacts between a patch and each of some others to `contacts`, which has room for all their pairs.
/// within: all are of one body, and the others may begin with the patch itself; then it leaves out what
/// Shape::excludes() says. Else the others are of another body.
PatchContacts find_patch_contacts(const Patches& patches, bool within, Index patch, Range others, float tolerance2,
                                  Contact* contacts);

}  // namespace collide::exact
