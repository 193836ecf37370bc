#pragma once
// Boxes in the lists of buckets, and which boxes share a bucket (§2.2, §2.3).
// Memory: 24 bytes for each bucket that a box is in, so 200 a box at eight corners, whatever the cells' size; 4 bytes a
// bucket; and a bit a box for each thread.

#include "collide/core/index_set.h"
#include "collide/methods/bucket_table.h"

namespace collide::methods {

class BoxTable {
 public:
  void clear();
  /// Puts the next box into each of the buckets, once however often it is named.
  void add(std::span<const std::uint32_t> buckets_of_box);
  /// Throws std::length_error at 2^32 entries, for which 6 GiB of positions would be needed.
  void build(std::uint32_t buckets);

  /// Calls meet(run) for all runs of consecutive boxes b >= least, ascending, that share a bucket with the box, each
  /// box once however many buckets the two share. least >= box. Prepare first, once and not in parallel.
  void prepare_meetings(int threads);
  template <class Meet>
  void for_each_run(int thread, Index box, Index least, const Meet& meet);

  std::size_t size() const { return first_.size() - 1; }
  const BucketTable& buckets() const { return table_; }
  /// Copies the boxes' buckets and the loads.
  void describe(DebugGeometry& geometry) const;

 private:
  /// Appends the box in the slot to the list of its bucket, which begins at first_slot; returns the place of its word.
  Index add_to_list(Index box, Index slot, Index first_slot);

  std::vector<std::uint32_t> first_{0};  // size() + 1 offsets into bucket_
  std::vector<std::uint32_t> bucket_;    // of each entry: box by box
  BucketTable table_;

  // Neighbouring boxes are often in one bucket. So a bucket's list holds words of an IndexSet, ascending, from the
  // bucket's first slot on; there are no more of them than slots.
  std::vector<Index> place_;          // of each slot's box: where its word is
  std::vector<Index> word_;           // by place
  std::vector<IndexSet::Word> bits_;  // by place
  std::vector<IndexSet> met_;         // by thread
};

template <class Meet>
void BoxTable::for_each_run(int thread, Index box, Index least, const Meet& meet) {
  IndexSet& met = met_[static_cast<std::size_t>(thread)];
  const Index least_word = least / IndexSet::word_size;
  const IndexSet::Word from_least = ~IndexSet::Word{0} << least % IndexSet::word_size;
  for (std::uint32_t entry = first_[box]; entry < first_[box + 1]; ++entry) {
    const Index last = place_[table_.slots(bucket_[entry]).end - 1];
    for (Index place = place_[table_.slot(entry)]; place <= last; ++place) {
      const Index word = word_[place];
      if (word >= least_word) met.add(word, word == least_word ? bits_[place] & from_least : bits_[place]);
    }
  }
  met.take_runs(least, meet);
}

}  // namespace collide::methods
