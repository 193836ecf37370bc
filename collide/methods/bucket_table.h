#pragma once
// The hash table of §2.2: entries sorted into buckets by counting. Each used bucket is a run of consecutive slots. A
// new build takes time in proportion to the entries, not to the buckets: only the buckets that were used are cleared.
// Memory: 4 bytes a bucket (64 MiB for max_buckets; after a larger table up to four times as much, or 4 MiB), and at
// most 12 bytes an entry.

#include "collide/core/detector.h"
#include "collide/core/points.h"

namespace collide::methods {

class BucketTable {
 public:
  /// Puts entry e into the bucket bucket_of_entry[e], which must be below `buckets`. The entries of a bucket keep their
  /// order. Buckets are in the order of their first entries.
  void build(std::span<const std::uint32_t> bucket_of_entry, std::uint32_t buckets);

  Index slot(std::size_t entry) const { return slot_[entry]; }
  Range slots(std::uint32_t bucket) const {
    const Index run = place_of_[bucket];
    return run == 0 ? Range{0, 0} : Range{used_buckets_[run - 1].begin, used_buckets_[run].begin};
  }

  std::uint32_t buckets() const { return static_cast<std::uint32_t>(place_of_.size()); }
  /// Returns the loads of the used buckets, in the order of their slots.
  std::vector<BucketLoad> loads() const;

 private:
  struct UsedBucket {
    std::uint32_t bucket;
    Index begin;  // slot
  };
  void clear(std::uint32_t buckets);

  std::vector<Index> place_of_;           // of each bucket: 1 + its place in used_buckets_, 0 if it is not used
  std::vector<UsedBucket> used_buckets_;  // and one more, where the slots end
  std::vector<Index> slot_;               // of each entry
};

}  // namespace collide::methods
