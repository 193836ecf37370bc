#pragma once
// Sorts pairs of small numbers by counting: much faster than by comparisons, which processors mispredict. Unlike
// CountingSort it runs on one thread, and moves the pairs themselves.

#include <cassert>
#include <cstdint>
#include <limits>
#include <vector>

#include "collide/core/frame.h"

namespace collide::surface {

struct ItemPair {
  Index a, b;
  auto operator<=>(const ItemPair&) const = default;
};

/// Keeps its memory from call to call. Pair: has members a and b.
template <class Pair>
class PairSort {
 public:
  /// Sorts the pairs by a, and those of equal a by b. end_a and end_b: above all a, and above all b.
  void sort(std::span<Pair> pairs, Index end_a, Index end_b) {
    assert(pairs.size() <= std::numeric_limits<std::uint32_t>::max());
    if (pairs.size() < 2) return;
    by_b_.resize(pairs.size());
    move(pairs, by_b_, &Pair::b, end_b);
    move(by_b_, pairs, &Pair::a, end_a);
  }

 private:
  void move(std::span<const Pair> from, std::span<Pair> to, Index Pair::*key, Index end) {
    next_.assign(end + std::size_t{1}, 0);
    for (const Pair& pair : from) {
      assert(pair.*key < end);
      ++next_[pair.*key + std::size_t{1}];
    }
    for (Index k = 0; k < end; ++k) next_[k + std::size_t{1}] += next_[k];
    for (const Pair& pair : from) to[next_[pair.*key]++] = pair;
  }

  std::vector<Pair> by_b_;
  std::vector<std::uint32_t> next_;  // of each key: where its next pair goes
};

}  // namespace collide::surface
