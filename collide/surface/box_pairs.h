#pragma once
// Finds the boxes that overlap, between two lists or within one. Cuts the area at midpoints as in §2.1, but only where
// enough boxes are left, and tests all pairs in the leaves.

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "collide/core/aabb.h"

namespace collide::surface {

/// Boxes with the numbers of their items. Padded with boxes that overlap nothing, for whole vectors at the end.
class BoxList {
 public:
  static constexpr Index padding = 16;
  std::array<std::vector<float>, 3> lo, hi;
  std::vector<Index> item;
  Index size = 0;

  void clear() { size = 0; }
  void reserve(Index count);
  /// Appends the box of item i. Precondition: there is room for it, see reserve().
  void add(const Aabb& box, Index i);
  void end();  // writes the padding; call it after the last add()
  Aabb box(Index k) const { return {{lo[0][k], lo[1][k], lo[2][k]}, {hi[0][k], hi[1][k], hi[2][k]}}; }
  /// Returns the box around all boxes. Precondition: size > 0.
  Aabb bounds() const;
};

struct ItemPair {
  Index a, b;
  auto operator<=>(const ItemPair&) const = default;
};

/// Finds pairs of overlapping boxes. Boxes are closed: two boxes that only touch overlap. Keeps its memory from call to
/// call.
class BoxPairs {
 public:
  /// Up to this many pairs are tested without a further cut; that takes some ten microseconds.
  static constexpr std::uint64_t leaf_tests = 1 << 18;
  static constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();

  /// Copies the boxes of `list` that overlap `box` to `picked`, in order.
  void pick(const BoxList& list, const Aabb& box, BoxList& picked);
  /// Append each pair of overlapping boxes once: (item of a, item of b), or two items of one list in the order of the
  /// list. The pairs are in no particular order. Throw std::length_error if `pairs` grows beyond max_pairs.
  void between(const BoxList& a, const BoxList& b, std::vector<ItemPair>& pairs, std::size_t max_pairs = unlimited);
  void within(const BoxList& list, std::vector<ItemPair>& pairs, std::size_t max_pairs = unlimited);

 private:
  struct Level {
    BoxList low_a, low_b, up_a, up_b;
  };
  /// a and b: the same list for the pairs within it.
  void cut(const BoxList& a, const BoxList& b, const glm::vec3& cell_lo, std::size_t depth);
  void test(const BoxList& a, Index i, const BoxList& b, Index begin, const glm::vec3& cell_lo);
  Level& level(std::size_t depth);

  std::vector<std::unique_ptr<Level>> levels_;
  std::vector<std::uint64_t> words_;
  std::vector<ItemPair>* pairs_ = nullptr;
  std::size_t max_pairs_ = unlimited;
};

}  // namespace collide::surface
