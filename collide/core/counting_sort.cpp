#include "collide/core/counting_sort.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace collide {

void CountingSort::sort(std::span<const Index> key_of_item, Index keys, Workers& workers) {
  const int threads = std::min(workers.threads(), max_threads);
  begin_.resize(keys + std::size_t{1});
  slot_.resize(key_of_item.size());
  total_.resize(static_cast<std::size_t>(threads));
  next_.resize(static_cast<std::size_t>(threads));
  begin_.back() = static_cast<Index>(key_of_item.size());
  workers.run([&](int thread) {
    const bool sorts = thread < threads;
    const Part items = sorts ? part_of(key_of_item.size(), thread, threads) : Part{0, 0};
    const Part own_keys = sorts ? part_of(keys, thread, threads) : Part{0, 0};
    std::vector<Index>* const next = sorts ? &next_[static_cast<std::size_t>(thread)] : nullptr;
    if (sorts) {
      next->assign(keys, 0);
      for (std::size_t item = items.begin; item < items.end; ++item) {
        assert(key_of_item[item] < keys);
        ++(*next)[key_of_item[item]];
      }
    }
    workers.barrier();
    if (sorts) {  // the items of its share of the keys
      Index total = 0;
      for (const std::vector<Index>& counts : next_) {
        for (std::size_t key = own_keys.begin; key < own_keys.end; ++key) total += counts[key];
      }
      total_[static_cast<std::size_t>(thread)] = total;
    }
    workers.barrier();
    Index place = 0;
    for (int before = 0; sorts && before < thread; ++before) place += total_[static_cast<std::size_t>(before)];
    for (std::size_t key = own_keys.begin; key < own_keys.end; ++key) {
      begin_[key] = place;
      for (std::vector<Index>& counts : next_) place += std::exchange(counts[key], place);
    }
    workers.barrier();
    for (std::size_t item = items.begin; item < items.end; ++item) slot_[item] = (*next)[key_of_item[item]]++;
  });
}

}  // namespace collide
