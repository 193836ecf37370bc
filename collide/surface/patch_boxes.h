#pragma once
// Finds the features of surfaces whose boxes overlap, between two lists or within one. The lists are cut into patches
// of 16 features, and groups of 16 patches: two flat levels in place of a tree. Vectorised with Highway; every
// instruction set finds the same pairs in the same order.

#include <bit>
#include <cstdint>

#include "collide/surface/surface.h"
#include "collide/trees/tree_search.h"

namespace collide::surface {

/// The boxes of the features of one kind, by their places in the patches, and those of the patches and groups.
struct PatchBoxes {
  using Columns = std::array<std::vector<float>, 3>;
  const FeaturePatches* features = nullptr;
  BoxColumns feature, patch, group;

  /// Finds the boxes from those of the vertices. room (m, of each vertex): a feature's box is grown by the largest of
  /// its vertices; not at all if there are none.
  void fill(const FeaturePatches& patches_of_features, const Columns& lo, const Columns& hi,
            std::span<const float> room = {});
  Index patches() const { return (features->size() + trees::patch_size - 1) / trees::patch_size; }
  Index groups() const { return (patches() + trees::patch_size - 1) / trees::patch_size; }
};

/// Keeps its memory from call to call.
class OverlapSearch {
 public:
  /// Lists each pair of overlapping boxes once: a feature of a and one of b. Boxes are closed: two that only touch
  /// overlap. The pairs are in no particular order. move_lo, move_hi: m, added to the corners of the boxes of a. Throws
  /// std::length_error if there are more than max_pairs.
  void find_between(const PatchBoxes& a, const glm::vec3& move_lo, const glm::vec3& move_hi, const PatchBoxes& b,
                    std::size_t max_pairs);
  /// Does the same within a surface, without joined pairs. a and b may be the same.
  void find_within(const PatchBoxes& a, const PatchBoxes& b, const JoinedPairs& joined, std::size_t max_pairs);
  std::size_t size() const { return found; }
  /// Calls visit(place in a, place in b) for each pair that was found last.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const Overlaps& o : std::span(overlaps).first(used))
      for (std::uint64_t bits = o.bits; bits != 0; bits &= bits - 1) {
        const auto bit = static_cast<Index>(std::countr_zero(bits));
        visit(o.a + bit / trees::patch_size, o.b + bit % trees::patch_size);
      }
  }

  // For the vectorised loops, and set by them.
  struct Overlaps {      // of four features and a patch
    Index a, b;          // places of the first ones
    std::uint64_t bits;  // bit 16 i + j: places a + i and b + j
  };
  std::vector<Overlaps> overlaps;
  std::size_t used = 0, found = 0;
  std::vector<Index> groups, patches;  // that are near

 private:
  void find(const PatchBoxes& a, const glm::vec3& move_lo, const glm::vec3& move_hi, const PatchBoxes& b,
            const JoinedPairs* joined, std::size_t max_pairs);
};

}  // namespace collide::surface
