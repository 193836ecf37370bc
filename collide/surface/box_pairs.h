#pragma once
// Which boxes of two lists, or of one, overlap: midpoint cuts as in §2.1, only where enough boxes are left, and all
// pairs in the leaves.

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "collide/core/aabb.h"

namespace collide::surface {

/// Boxes of numbered items. Padded with boxes that overlap nothing.
class BoxList {
 public:
  static constexpr Index padding = 16;
  std::array<std::vector<float>, 3> lo, hi;
  std::vector<Index> item;
  Index size = 0;

  void clear() { size = 0; }
  void reserve(Index count);
  void add(const Aabb& box, Index i);
  void end();  // writes the padding
  Aabb box(Index k) const { return {{lo[0][k], lo[1][k], lo[2][k]}, {hi[0][k], hi[1][k], hi[2][k]}}; }
  /// Around all of them; size > 0.
  Aabb bounds() const;
};

struct ItemPair {
  Index a, b;
  auto operator<=>(const ItemPair&) const = default;
};

/// Keeps its memory.
class BoxPairs {
 public:
  /// Below so many tests, which take some ten microseconds, all pairs are cheaper than a cut.
  static constexpr std::uint64_t leaf_tests = 1 << 18;
  static constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();

  /// Boxes closed: they overlap where they touch. Takes those of `list` that overlap `box`, in order.
  void pick(const BoxList& list, const Aabb& box, BoxList& picked);
  /// Appends (item of a, item of b) of overlapping boxes, or of one list (the greater place second), each once;
  /// ascending if the lists are. Throws std::length_error once `pairs` has more than `most`.
  void between(const BoxList& a, const BoxList& b, std::vector<ItemPair>& pairs, std::size_t most = unlimited);
  void within(const BoxList& list, std::vector<ItemPair>& pairs, std::size_t most = unlimited);

 private:
  struct Level {
    BoxList low_a, low_b, up_a, up_b;
  };
  void cut_between(const BoxList& a, const BoxList& b, const glm::vec3& from, std::size_t depth);
  void cut_within(const BoxList& list, const glm::vec3& from, std::size_t depth);
  void test(const BoxList& a, Index i, const BoxList& b, Index begin, const glm::vec3& from);
  Level& level(std::size_t depth);

  std::vector<std::unique_ptr<Level>> levels_;
  std::vector<std::uint64_t> words_;
  std::vector<ItemPair>* pairs_ = nullptr;
  std::size_t most_ = unlimited;
};

}  // namespace collide::surface
