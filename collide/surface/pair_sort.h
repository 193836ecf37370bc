#pragma once
// Sorts pairs of small numbers, by counting: much faster than by comparing, which most processors mispredict.

#include <cassert>
#include <cstdint>
#include <vector>

#include "collide/core/points.h"

namespace collide::surface {

/// Pair: any with the members a and b. Keeps its memory from call to call.
template <class Pair>
class PairSort {
 public:
  /// Sorts the pairs from `first` on by a, and those of equal a by b. Equal pairs keep their order. end_a and end_b:
  /// above all a, and above all b.
  void sort(std::vector<Pair>& pairs, std::size_t first, Index end_a, Index end_b) {
    assert(first <= pairs.size());
    by_b_.resize(pairs.size() - first);
    move(pairs.data() + first, by_b_.data(), &Pair::b, end_b);
    move(by_b_.data(), pairs.data() + first, &Pair::a, end_a);
  }

 private:
  /// Copies by_b_.size() pairs, by the counts of their keys.
  void move(const Pair* from, Pair* to, Index Pair::*key, Index end) {
    next_.assign(end + std::size_t{1}, 0);
    for (std::size_t i = 0; i < by_b_.size(); ++i) {
      assert(from[i].*key < end);
      ++next_[from[i].*key + std::size_t{1}];
    }
    for (Index k = 0; k < end; ++k) next_[k + std::size_t{1}] += next_[k];
    for (std::size_t i = 0; i < by_b_.size(); ++i) to[next_[from[i].*key]++] = from[i];
  }

  std::vector<Pair> by_b_;
  std::vector<std::uint32_t> next_;  // of each key: where its next pair goes
};

}  // namespace collide::surface
