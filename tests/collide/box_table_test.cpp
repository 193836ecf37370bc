#include "collide/methods/box_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace collide::test {

using namespace collide::methods;
namespace THIS_FILE {

TEST(BoxTable, BoxesMeetThatShareABucketOrAreEverywhere) {
  std::mt19937 random(53);
  BoxTable table;
  for (int trial = 0; trial < 40; ++trial) {
    const std::uint32_t buckets = trial % 2 == 0 ? 50 : 5000;
    std::vector<std::vector<std::uint32_t>> boxes(1 + random() % 300);
    table.clear();
    for (auto& of_box : boxes) {
      of_box.resize(random() % 9 == 0 ? random() % 100 : random() % 4);  // none: everywhere
      for (std::uint32_t& bucket : of_box) bucket = static_cast<std::uint32_t>(random() % buckets);
      table.add(of_box);
      std::ranges::sort(of_box);
    }
    table.build(buckets);
    table.prepare_meetings(1);
    for (Index a = 0; a < boxes.size(); ++a) {
      const Index least = a + static_cast<Index>(random() % 3);
      std::vector<Index> expected, met;
      for (Index b = least; b < boxes.size(); ++b) {
        std::vector<std::uint32_t> shared;
        std::ranges::set_intersection(boxes[a], boxes[b], std::back_inserter(shared));
        if (!shared.empty() || boxes[a].empty() || boxes[b].empty()) expected.push_back(b);
      }
      table.for_each_run(0, a, least, [&](Range run) {
        for (Index b = run.begin; b < run.end; ++b) met.push_back(b);
      });
      ASSERT_EQ(met, expected);
    }
  }
}

TEST(BoxTable, NamesEachBucketOfABoxOnceAndTheFirstOneFirst) {
  std::vector<std::uint32_t> many{70};
  for (std::uint32_t i = 0; i < 200; ++i) many.push_back(i % 100);
  const std::vector<std::uint32_t> few{3, 1, 3, 2, 1};
  BoxTable table;
  table.clear();
  table.add(many);
  table.add(few);
  table.build(100);
  DebugGeometry geometry;
  table.describe(geometry);
  EXPECT_EQ(geometry.box_first, (std::vector<std::uint32_t>{0, 100, 103}));
  EXPECT_EQ(geometry.box_bucket.front(), 70u);
  EXPECT_EQ(std::vector(geometry.box_bucket.begin() + 100, geometry.box_bucket.end()),
            (std::vector<std::uint32_t>{3, 1, 2}));
}

}  // namespace THIS_FILE
}  // namespace collide::test
