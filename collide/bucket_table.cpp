#include "collide/bucket_table.h"

#include <algorithm>

namespace collide {

namespace {

constexpr std::size_t worth_returning = 1u << 20;  // offsets, of 4 MiB

}  // namespace

void BucketTable::build(std::span<const std::uint32_t> bucket_of_entry, std::uint32_t buckets) {
  const std::size_t offsets = buckets + std::size_t{1};
  if (first_.capacity() > std::max(worth_returning, 4 * offsets)) first_ = std::vector<Index>();  // was larger by far
  first_.assign(offsets, 0);
  for (const std::uint32_t bucket : bucket_of_entry) ++first_[bucket];

  meetings_ = used_ = longest_ = 0;
  Index end = 0;
  for (Index& load : first_) {  // becomes the end of each bucket
    const std::uint64_t n = load;
    used_ += n > 0;
    longest_ = std::max(longest_, n);
    meetings_ += n > 1 ? n * (n - 1) / 2 : 0;
    load = end += load;
  }

  slot_.resize(bucket_of_entry.size());
  for (std::size_t e = bucket_of_entry.size(); e-- > 0;) slot_[e] = --first_[bucket_of_entry[e]];
}

void BucketTable::count(Counters& counters) const {
  counters.buckets_used = used_;
  counters.longest_bucket = longest_;
}

std::vector<std::uint32_t> BucketTable::loads() const {
  std::vector<std::uint32_t> loads(first_.empty() ? 0 : first_.size() - 1);
  for (std::size_t b = 0; b < loads.size(); ++b) loads[b] = first_[b + 1] - first_[b];
  return loads;
}

}  // namespace collide
