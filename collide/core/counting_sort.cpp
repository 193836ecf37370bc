#include "collide/core/counting_sort.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace collide {

void CountingSort::sort(std::span<const Index> key_of_item, Index keys, Workers& workers) {
  constexpr double item_ns = 3, key_ns = 1;  // of work
  const int parts =
      std::min(workers.threads_for(item_ns * static_cast<double>(key_of_item.size()) + key_ns * keys), max_parts);
  const auto each = [&](const std::function<void(std::size_t part, Part items, Part keys)>& task) {
    workers.run(parts, [&](int part) {
      task(static_cast<std::size_t>(part), part_of(key_of_item.size(), part, parts), part_of(keys, part, parts));
    });
  };
  begin_.resize(keys + std::size_t{1});
  slot_.resize(key_of_item.size());
  total_.resize(static_cast<std::size_t>(parts));
  next_.resize(static_cast<std::size_t>(parts));
  begin_.back() = static_cast<Index>(key_of_item.size());
  each([&](std::size_t part, Part items, Part) {
    std::vector<Index>& next = next_[part];
    next.assign(keys, 0);
    for (std::size_t item = items.begin; item < items.end; ++item) {
      assert(key_of_item[item] < keys);
      ++next[key_of_item[item]];
    }
  });
  each([&](std::size_t part, Part, Part own_keys) {  // the items of its share of the keys
    Index total = 0;
    for (const std::vector<Index>& counts : next_) {
      for (std::size_t key = own_keys.begin; key < own_keys.end; ++key) total += counts[key];
    }
    total_[part] = total;
  });
  each([&](std::size_t part, Part, Part own_keys) {
    Index place = 0;
    for (std::size_t before = 0; before < part; ++before) place += total_[before];
    for (std::size_t key = own_keys.begin; key < own_keys.end; ++key) {
      begin_[key] = place;
      for (std::vector<Index>& counts : next_) place += std::exchange(counts[key], place);
    }
  });
  each([&](std::size_t part, Part items, Part) {
    std::vector<Index>& next = next_[part];
    for (std::size_t item = items.begin; item < items.end; ++item) slot_[item] = next[key_of_item[item]]++;
  });
}

}  // namespace collide
