#include "collide/core/counting_sort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace collide::test {
namespace THIS_FILE {

TEST(CountingSort, IsAStableSortOnAnyNumberOfThreads) {
  std::mt19937 random(51);
  std::array<Workers, 4> workers{Workers(1), Workers(2, 0), Workers(3, 0), Workers(11, 0)};
  CountingSort sort;
  for (int trial = 0; trial < 60; ++trial) {
    const auto keys = static_cast<Index>(1 + random() % (trial % 2 == 0 ? 5 : 300));
    std::vector<Index> key_of_item(random() % 200);
    for (Index& key : key_of_item) key = static_cast<Index>(random() % keys);
    std::vector<Index> order(key_of_item.size());
    std::iota(order.begin(), order.end(), Index{0});
    std::ranges::stable_sort(order, {}, [&](Index item) { return key_of_item[item]; });

    sort.sort(key_of_item, keys, workers[static_cast<std::size_t>(trial) % workers.size()]);
    for (Index place = 0; place < order.size(); ++place) ASSERT_EQ(sort.slot(order[place]), place);
    ASSERT_EQ(sort.begins().size(), keys + std::size_t{1});
    for (Index key = 0; key < keys; ++key) {
      const auto by_key = [&](Index item) { return key_of_item[item]; };
      ASSERT_EQ(sort.slots(key).begin, std::ranges::lower_bound(order, key, {}, by_key) - order.begin());
      ASSERT_EQ(sort.slots(key).end, std::ranges::upper_bound(order, key, {}, by_key) - order.begin());
    }
  }
}

}  // namespace THIS_FILE
}  // namespace collide::test
