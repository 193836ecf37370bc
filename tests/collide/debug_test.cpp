#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "collide/core/cutoff.h"
#include "collide/methods/cell_hash.h"
#include "states.h"
#include "tests/bucket_loads.h"

namespace collide::test {

using namespace collide::methods;
namespace THIS_FILE {

DebugGeometry picture(std::string_view method, const State& state, const Settings& settings) {
  Workers workers(1);
  Result result;
  const auto detector = find_method(method)->make();
  detector->detect(state.frame(), settings, workers, result);
  return detector->debug();
}

Settings settings_of(const State& state, float cell) {
  return {.tolerance = state.tolerance, .cell_size = glm::vec3(cell)};
}

TEST(Debug, IsEmptyBeforeTheFirstFrame) {
  for (const Method& method : method_table()) {
    const DebugGeometry geometry = method.make()->debug();
    EXPECT_TRUE(geometry.boxes.empty() && geometry.cells.empty() && geometry.loads.empty()) << method.key;
  }
}

TEST(Debug, AgreesWithItselfAndWithTheHash) {
  for (const NamedState& named : named_states()) {
    const State state = named.make();
    for (const Method& method : method_table()) {
      if (!method.uses_hash) continue;
      const Settings settings = settings_of(state, 0.5f);
      const DebugGeometry geometry = picture(method.key, state, settings);
      const CellHash hash(settings);
      ASSERT_EQ(geometry.buckets, settings.buckets);
      const std::vector<std::uint32_t> loads = tests::bucket_loads(geometry);
      ASSERT_EQ(std::size_t(std::ranges::count_if(loads, [](std::uint32_t load) { return load > 0; })),
                geometry.loads.size());
      ASSERT_TRUE(std::is_sorted(geometry.cells.begin(), geometry.cells.end()));
      ASSERT_EQ(std::adjacent_find(geometry.cells.begin(), geometry.cells.end()), geometry.cells.end());
      ASSERT_LE(geometry.cells.size(), DebugGeometry::debug_cell_limit);
      std::set<std::uint32_t> buckets;
      for (const auto& cell : geometry.cells) {
        ASSERT_EQ(cell.bucket, hash.bucket(cell.index));
        ASSERT_GT(loads[cell.bucket], 0u);
        buckets.insert(cell.bucket);
      }
      if (geometry.cells.size() < DebugGeometry::debug_cell_limit) {
        ASSERT_EQ(buckets.size(), geometry.loads.size()) << named.name << method.key;
      }
      ASSERT_EQ(geometry.box_first.size(), geometry.boxes.size() + 1);
      ASSERT_EQ(geometry.box_first.back(), geometry.box_bucket.size());
      if (!method.uses_levels) continue;
      std::vector<std::uint32_t> load(settings.buckets, 0);
      for (const std::uint32_t bucket : geometry.box_bucket) ++load[bucket];
      ASSERT_EQ(load, loads) << named.name << method.key;
    }
  }
}

TEST(Debug, OfTheLiteralMethodShowsCornersMinimumFirst) {
  const State state = named_states()[1].make();
  const Settings settings = settings_of(state, 0.2f);
  const DebugGeometry geometry = picture("multi-level-sb", state, settings);
  const CellHash hash(settings);
  ASSERT_FALSE(geometry.boxes.empty());
  for (std::size_t b = 0; b < geometry.boxes.size(); ++b) {
    const auto& [lo, hi, body] = geometry.boxes[b];
    EXPECT_EQ(geometry.box_bucket[geometry.box_first[b]], hash.bucket(hash.cell(lo.x, lo.y, lo.z)));
    const auto cell = hash.cell(hi.x, lo.y, hi.z);
    EXPECT_TRUE(
        std::binary_search(geometry.cells.begin(), geometry.cells.end(), DebugGeometry::Cell{cell, hash.bucket(cell)}));
  }
}

TEST(Debug, OfTheExactMethodShowsWhereBodiesOverlap) {
  State state;
  state.add({glm::vec3(0), glm::vec3(1)});
  state.add({glm::vec3(0.5f, 0.25f, 0.75f), glm::vec3(2)});
  state.tolerance = 0.2f;
  Settings settings = settings_of(state, 1);
  settings.self_collision = false;
  const DebugGeometry geometry = picture("multi-level-sb-exact", state, settings);
  ASSERT_EQ(geometry.boxes.size(), 1u);
  EXPECT_EQ(geometry.boxes[0].body, 0u);
  const glm::vec3 lo(0.4f, 0.15f, 0.65f);  // half a tolerance more than both have in common
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(geometry.boxes[0].lo[axis], lo[axis], 1e-5);
    EXPECT_NEAR(geometry.boxes[0].hi[axis], 1.1, 1e-5);
  }
  EXPECT_TRUE(geometry.cells.empty() && geometry.loads.empty() && geometry.buckets == 0 && geometry.box_bucket.empty());
  EXPECT_EQ(geometry.box_first, (std::vector<std::uint32_t>{0, 0}));
}

TEST(Debug, OfTheExactMethodShowsTheLeavesOfItsCuts) {
  State state;
  std::mt19937 random(31);
  for (int body = 0; body < 2; ++body) state.add(random_points(random, 400, 0, 1));
  EXPECT_GT(picture("multi-level-sb-exact", state, settings_of(state, 1)).boxes.size(), 4u);
}

TEST(Debug, KeepsTheFirstCellsWhereThereAreTooMany) {
  CellList cells;
  CellHash hash{metre_cells()};
  for (std::int64_t i = 2'000'000; i-- > 0;) cells.add({i / 2, 0, 0}, hash);
  const auto kept = cells.take();
  ASSERT_EQ(kept.size(), DebugGeometry::debug_cell_limit);
  EXPECT_EQ(kept.front().index[0], 0);
  EXPECT_EQ(kept.back().index[0], static_cast<std::int64_t>(DebugGeometry::debug_cell_limit) - 1);
}

}  // namespace THIS_FILE
}  // namespace collide::test
