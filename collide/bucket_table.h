#pragma once
// Things sorted into buckets (§2.2) by counting: one array of slots, in which each bucket is a run.
// Memory: 4 bytes a bucket (64 MiB for max_buckets) and 4 an entry; after a larger table up to
// four times as much, or 4 MiB.

#include "collide/detector.h"
#include "collide/points.h"

namespace collide {

class BucketTable {
 public:
  /// Entry e goes into the bucket bucket_of_entry[e] < buckets; the entries of a bucket keep their order.
  void build(std::span<const std::uint32_t> bucket_of_entry, std::uint32_t buckets);

  Index slot(std::size_t entry) const { return slot_[entry]; }
  Range slots(std::uint32_t bucket) const { return {first_[bucket], first_[bucket + std::size_t{1}]}; }

  /// Two entries of one bucket, counted over all buckets: what looking at every pair would cost.
  std::uint64_t meetings() const { return meetings_; }
  void count(Counters& counters) const;
  std::vector<std::uint32_t> loads() const;

 private:
  std::vector<Index> first_;  // buckets + 1 offsets into the slots
  std::vector<Index> slot_;   // of each entry
  std::uint64_t meetings_ = 0, used_ = 0, longest_ = 0;
};

}  // namespace collide
