#include "collide/box_table.h"

namespace collide {

void BoxTable::clear() {
  first_.assign(1, 0);
  bucket_.clear();
}

void BoxTable::add(std::span<const std::uint32_t> buckets_of_box) {
  const auto begin = static_cast<std::ptrdiff_t>(bucket_.size());
  for (const std::uint32_t bucket : buckets_of_box) {
    if (std::find(bucket_.begin() + begin, bucket_.end(), bucket) == bucket_.end()) bucket_.push_back(bucket);
  }
  first_.push_back(static_cast<std::uint32_t>(bucket_.size()));
}

void BoxTable::build(std::uint32_t buckets) {
  table_.build(bucket_, buckets);
  box_in_slot_.resize(bucket_.size());
  for (std::size_t box = 0; box < size(); ++box) {
    for (std::uint32_t entry = first_[box]; entry < first_[box + 1]; ++entry) {
      box_in_slot_[table_.slot(entry)] = static_cast<Index>(box);
    }
  }
}

void BoxTable::describe(DebugGeometry& geometry) const {
  geometry.box_first = first_;
  geometry.box_bucket = bucket_;
  geometry.bucket_load = table_.loads();
}

}  // namespace collide
