#include "collide/methods/box_table.h"

#include <algorithm>
#include <stdexcept>

namespace collide::methods {

void BoxTable::clear() {
  first_.assign(1, 0);
  bucket_.clear();
}

void BoxTable::add(std::span<const std::uint32_t> buckets_of_box) {
  constexpr std::size_t few = 32;
  const auto begin = static_cast<std::ptrdiff_t>(bucket_.size());
  if (buckets_of_box.size() <= few) {
    for (const std::uint32_t bucket : buckets_of_box) {
      if (std::find(bucket_.begin() + begin, bucket_.end(), bucket) == bucket_.end()) bucket_.push_back(bucket);
    }
  } else {  // the first one stays the first
    bucket_.insert(bucket_.end(), buckets_of_box.begin(), buckets_of_box.end());
    const std::uint32_t first = buckets_of_box.front();
    bucket_.erase(std::remove(bucket_.begin() + begin + 1, bucket_.end(), first), bucket_.end());
    std::sort(bucket_.begin() + begin + 1, bucket_.end());
    bucket_.erase(std::unique(bucket_.begin() + begin + 1, bucket_.end()), bucket_.end());
  }
  first_.push_back(static_cast<std::uint32_t>(bucket_.size()));
}

void BoxTable::build(std::uint32_t buckets) {
  if (bucket_.size() > ~std::uint32_t{0}) throw std::length_error("too many boxes for one table: use fewer levels");
  table_.build(bucket_, buckets);
  place_.resize(bucket_.size());
  word_.resize(bucket_.size());
  bits_.resize(bucket_.size());
  everywhere_.clear();
  for (Index box = 0; box < size(); ++box) {
    if (everywhere(box)) {
      const Index word = box / IndexSet::word_size;
      if (everywhere_.empty() || everywhere_.back().first != word) everywhere_.emplace_back(word, 0);
      everywhere_.back().second |= IndexSet::Word{1} << box % IndexSet::word_size;
    }
    for (std::uint32_t entry = first_[box]; entry < first_[box + 1]; ++entry) {
      const Index slot = table_.slot(entry);
      place_[slot] = add_to_list(box, slot, table_.slots(bucket_[entry]).begin);
    }
  }
}

Index BoxTable::add_to_list(Index box, Index slot, Index first_slot) {
  const Index word = box / IndexSet::word_size;
  const IndexSet::Word bit = IndexSet::Word{1} << box % IndexSet::word_size;
  Index place = first_slot;
  if (slot > first_slot) {
    place = place_[slot - 1];  // boxes come in the order of the slots, so this one is known
    if (word_[place] == word) {
      bits_[place] |= bit;
      return place;
    }
    ++place;
  }
  word_[place] = word;
  bits_[place] = bit;
  return place;
}

void BoxTable::prepare_meetings(int threads) {
  met_.resize(static_cast<std::size_t>(threads));
  for (IndexSet& met : met_) met.reset(static_cast<Index>(size()));
}

void BoxTable::describe(DebugGeometry& geometry) const {
  geometry.box_first = first_;
  geometry.box_bucket = bucket_;
  geometry.buckets = table_.buckets();
  geometry.loads = table_.loads();
}

}  // namespace collide::methods
