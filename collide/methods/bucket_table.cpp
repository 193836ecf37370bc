#include "collide/methods/bucket_table.h"

#include <algorithm>
#include <cassert>

namespace collide::methods {

namespace {

constexpr std::size_t worth_returning = 1u << 20;  // buckets, of 4 MiB

}  // namespace

void BucketTable::clear(std::uint32_t buckets) {
  if (place_of_.capacity() > std::max(worth_returning, 4 * std::size_t{buckets}))
    place_of_ = std::vector<Index>();  // was larger by far
  if (place_of_.size() == buckets) {
    for (std::size_t r = 0; r + 1 < used_buckets_.size(); ++r) place_of_[used_buckets_[r].bucket] = 0;
  } else {
    place_of_.assign(buckets, 0);
  }
  used_buckets_.clear();
}

void BucketTable::build(std::span<const std::uint32_t> bucket_of_entry, std::uint32_t buckets) {
  clear(buckets);
  used_buckets_.reserve(std::min<std::size_t>(buckets, bucket_of_entry.size()) +
                        1);  // from here on nothing throws half-way
  slot_.resize(bucket_of_entry.size());
  for (const std::uint32_t bucket : bucket_of_entry) {
    assert(bucket < buckets);
    Index& run = place_of_[bucket];
    if (run == 0) {
      used_buckets_.push_back({bucket, 0});
      run = static_cast<Index>(used_buckets_.size());
    }
    ++used_buckets_[run - 1].begin;  // its load, at first
  }

  Index end = 0;
  for (UsedBucket& run : used_buckets_) run.begin = end += run.begin;  // the end of each run
  used_buckets_.push_back({buckets, end});

  for (std::size_t e = bucket_of_entry.size(); e-- > 0;)
    slot_[e] = --used_buckets_[place_of_[bucket_of_entry[e]] - 1].begin;
}

std::vector<BucketLoad> BucketTable::loads() const {
  std::vector<BucketLoad> loads;
  for (std::size_t r = 0; r + 1 < used_buckets_.size(); ++r)
    loads.push_back({used_buckets_[r].bucket, used_buckets_[r + 1].begin - used_buckets_[r].begin});
  return loads;
}

}  // namespace collide::methods
