#pragma once
// Boxes in the lists of buckets, and the pairs of boxes that share a bucket (§2.2, §2.3).

#include <algorithm>

#include "collide/bucket_table.h"
#include "collide/subdivision.h"

namespace collide {

class BoxTable {
 public:
  void clear();
  /// Puts the next box into each of the buckets, once however often it is named.
  void add(std::span<const std::uint32_t> buckets_of_box);
  void build(std::uint32_t buckets);

  /// The part of one thread of all pairs a < b of boxes that share a bucket: calls meet(a, b) once for each pair,
  /// however many buckets the two share. Prepare first, once and not in parallel.
  void prepare_pairs(int threads) { met_.resize(static_cast<std::size_t>(threads)); }
  template <class Meet>
  void for_each_pair(int thread, int threads, const Meet& meet);

  std::size_t size() const { return first_.size() - 1; }
  const BucketTable& buckets() const { return table_; }
  /// Copies the boxes' buckets and the loads.
  void describe(DebugGeometry& geometry) const;

 private:
  std::vector<std::uint32_t> first_{0};  // size() + 1 offsets into bucket_
  std::vector<std::uint32_t> bucket_;    // of each entry: box by box
  BucketTable table_;
  std::vector<Index> box_in_slot_;       // ascending within a bucket
  std::vector<std::vector<Index>> met_;  // by thread, for each box: the last box it has met
};

template <class Meet>
void BoxTable::for_each_pair(int thread, int threads, const Meet& meet) {
  const auto boxes = static_cast<Index>(size());
  std::vector<Index>& met = met_[static_cast<std::size_t>(thread)];
  met.assign(boxes, boxes);
  for (auto a = static_cast<Index>(thread); a < boxes; a += static_cast<Index>(threads)) {
    for (std::uint32_t entry = first_[a]; entry < first_[a + 1]; ++entry) {
      const Index end = table_.slots(bucket_[entry]).end;
      for (Index slot = table_.slot(entry) + 1; slot < end; ++slot) {
        const Index b = box_in_slot_[slot];
        if (met[b] == a) continue;
        met[b] = a;
        meet(a, b);
      }
    }
  }
}

}  // namespace collide
