#pragma once
// A stable counting sort on all threads. Memory: 4 bytes an item, and 4 bytes a key for each of at most 8 parts.

#include "collide/core/points.h"
#include "collide/core/workers.h"

namespace collide {

class CountingSort {
 public:
  /// Sorts items by their keys, which must be below `keys`. Items of one key keep their order.
  void sort(std::span<const Index> key_of_item, Index keys, Workers& workers);

  /// Returns the place of an item.
  Index slot(std::size_t item) const { return slot_[item]; }
  /// Returns the places of a key's items.
  Range slots(Index key) const { return {begin_[key], begin_[key + std::size_t{1}]}; }
  /// Returns where the items of each key begin, and where the last ones end.
  std::span<const Index> begins() const { return begin_; }

 private:
  static constexpr int max_parts = 8;
  std::vector<Index> begin_, slot_, total_;
  std::vector<std::vector<Index>> next_;  // by part: how many items each key has, then the next one's place
};

}  // namespace collide
