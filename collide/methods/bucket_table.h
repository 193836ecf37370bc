#pragma once
// Things sorted into buckets (§2.2) by counting: one array of slots, in which each bucket that is used is a run. To
// build it again takes the time of the entries, however many buckets there are: only those that were used are cleared.
// Memory: 4 bytes a bucket (64 MiB for max_buckets; after a larger table up to four times as much, or 4 MiB), and at
// most 12 an entry.

#include "collide/core/detector.h"
#include "collide/core/points.h"

namespace collide::methods {

class BucketTable {
 public:
  /// Entry e goes into the bucket bucket_of_entry[e] < buckets; the entries of a bucket keep their order, and buckets
  /// have that of their first entries.
  void build(std::span<const std::uint32_t> bucket_of_entry, std::uint32_t buckets);

  Index slot(std::size_t entry) const { return slot_[entry]; }
  Range slots(std::uint32_t bucket) const {
    const Index run = run_of_[bucket];
    return run == 0 ? Range{0, 0} : Range{runs_[run - 1].begin, runs_[run].begin};
  }

  /// Two entries of one bucket, counted over all buckets: what looking at every pair would cost.
  std::uint64_t meetings() const { return meetings_; }
  void count(Counters& counters) const;
  std::size_t bytes() const {
    return sizeof(Index) * (run_of_.capacity() + slot_.capacity()) + sizeof(VertexRun) * runs_.capacity();
  }
  std::uint32_t buckets() const { return static_cast<std::uint32_t>(run_of_.size()); }
  /// Of the buckets that are used, in the order of their runs.
  std::vector<BucketLoad> loads() const;

 private:
  struct VertexRun {
    std::uint32_t bucket;
    Index begin;  // slot
  };
  void clear(std::uint32_t buckets);

  std::vector<Index> run_of_;    // of each bucket: 1 + its place in runs_, 0 if it is not used
  std::vector<VertexRun> runs_;  // and one more, where the slots end
  std::vector<Index> slot_;      // of each entry
  std::uint64_t meetings_ = 0, used_ = 0, longest_ = 0;
};

}  // namespace collide::methods
