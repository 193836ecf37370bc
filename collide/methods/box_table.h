#pragma once
// The lists of boxes in the buckets, and the boxes that share a bucket (§2.2, §2.3).
// Memory: 24 bytes for each bucket that a box is in, so 200 bytes a box with eight corners, whatever the size of the
// cells; 4 bytes a bucket; one bit a box and thread. A box in too many buckets need not be listed: see add().

#include <cassert>

#include "collide/core/index_set.h"
#include "collide/methods/bucket_table.h"

namespace collide::methods {

class BoxTable {
 public:
  void clear();
  /// Adds the next box to each of its buckets. A bucket may be named more than once; the box joins it once. A box
  /// without buckets is everywhere: it meets every box.
  void add(std::span<const std::uint32_t> buckets_of_box);
  /// Builds the table from the boxes added. Throws std::length_error at 2^32 entries (that takes 6 GiB of positions).
  void build(std::uint32_t buckets);

  /// Calls meet(run) for every run of consecutive boxes b >= least that `box` meets; ascending. Boxes meet if they
  /// share a bucket or if one of them is everywhere. Each b comes up once, however many buckets the two boxes share.
  /// least >= box. Call prepare_meetings() before, on one thread.
  void prepare_meetings(int threads);
  template <class Meet>
  void for_each_run(int thread, Index box, Index least, const Meet& meet);

  std::size_t size() const { return first_.size() - 1; }
  /// Copies the buckets of each box and the loads, for drawing.
  void describe(DebugGeometry& geometry) const;

 private:
  bool everywhere(Index box) const { return first_[box] == first_[box + std::size_t{1}]; }
  /// Appends a box to the list of its bucket, which begins at first_slot. Returns the place of the box's word.
  Index add_to_list(Index box, Index slot, Index first_slot);

  std::vector<std::uint32_t> first_{0};  // size() + 1 offsets into bucket_
  std::vector<std::uint32_t> bucket_;    // of each entry: box by box
  BucketTable table_;

  // Neighbouring boxes are often in the same bucket. So the list of a bucket holds words of an IndexSet; ascending,
  // from the bucket's first slot on. A bucket has no more words than slots.
  std::vector<Index> place_;                                  // of each slot's box: where its word is
  std::vector<Index> word_;                                   // by place
  std::vector<IndexSet::Word> bits_;                          // by place
  std::vector<std::pair<Index, IndexSet::Word>> everywhere_;  // the words of the boxes that are everywhere; ascending
  std::vector<IndexSet> met_;                                 // by thread
};

template <class Meet>
void BoxTable::for_each_run(int thread, Index box, Index least, const Meet& meet) {
  assert(least >= box);
  if (everywhere(box)) {
    if (least < size()) meet(Range{least, static_cast<Index>(size())});
    return;
  }
  IndexSet& met = met_[static_cast<std::size_t>(thread)];
  const Index least_word = least / IndexSet::word_size;
  const IndexSet::Word from_least = ~IndexSet::Word{0} << least % IndexSet::word_size;
  const auto add = [&met, least_word, from_least](Index word, IndexSet::Word bits) {
    if (word >= least_word) met.add(word, word == least_word ? bits & from_least : bits);
  };
  for (std::uint32_t entry = first_[box]; entry < first_[box + 1]; ++entry) {
    const Index last = place_[table_.slots(bucket_[entry]).end - 1];
    for (Index place = place_[table_.slot(entry)]; place <= last; ++place) add(word_[place], bits_[place]);
  }
  for (const auto& [word, bits] : everywhere_) add(word, bits);
  met.take_runs(least, meet);
}

}  // namespace collide::methods
