#include "app/compare/table_contents.h"

#include <gtest/gtest.h>

#include <set>

#include "collide/methods.h"
#include "collide/methods/detectors.h"
#include "softbody/world/world.h"
#include "tests/app/scenes.h"
#include "tests/bucket_loads.h"

namespace app {
namespace THIS_FILE {

using collide::Index;

class TableContentsOf : public testing::TestWithParam<std::tuple<const char*, std::uint32_t, float>> {};

/// Two bodies in contact.
const softbody::World& world() {
  static const softbody::World pair(touching_pair(), {});
  return pair;
}

collide::DebugGeometry structure(std::string_view method, const collide::Settings& settings) {
  collide::Workers alone(1);
  collide::Result result;
  const auto detector = collide::find_method(method)->make();
  detector->detect(world().positions(), settings, alone, result);
  return detector->debug();
}

/// Counts pair by pair, from the definition.
compare::Sharing counted_one_by_one(const compare::BucketContents& bucket) {
  std::vector<std::pair<std::size_t, Index>> entries;  // group, item
  for (std::size_t g = 0; g < bucket.groups.size(); ++g)
    for (const Index item : bucket.groups[g].items) entries.emplace_back(g, item);
  compare::Sharing sharing;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (entries[i].second == entries[j].second) continue;
      ++(entries[i].first == entries[j].first ? sharing.same_cell : sharing.aliased);
    }
  }
  return sharing;
}

TEST_P(TableContentsOf, HasTheEntriesOfEachBucket) {
  const auto [method, buckets, cell] = GetParam();
  collide::Settings settings;
  settings.buckets = buckets;
  settings.cell_size = glm::vec3(cell);
  const collide::DebugGeometry debug = structure(method, settings);
  const compare::TableContents table(debug, world().positions(), settings);
  const collide::methods::CellHash hash(settings);
  const std::vector<std::uint32_t> loads = tests::bucket_loads(debug);
  compare::Sharing sum;
  for (std::uint32_t b = 0; b < buckets; ++b) {
    const compare::BucketContents bucket = table.bucket(b);
    ASSERT_EQ(bucket.items, loads[b]);
    std::set<compare::Cell> cells;
    for (std::size_t g = 0; g < bucket.groups.size(); ++g) {
      ASSERT_EQ(hash.bucket(bucket.groups[g].cell), b);
      ASSERT_TRUE(cells.insert(bucket.groups[g].cell).second);
      ASSERT_LE(bucket.groups[g].items.size(), bucket.groups[g == 0 ? 0 : g - 1].items.size());
    }
    const compare::Sharing expected = counted_one_by_one(bucket);
    ASSERT_EQ(bucket.sharing.same_cell, expected.same_cell);
    ASSERT_EQ(bucket.sharing.aliased, expected.aliased);
    sum.same_cell += expected.same_cell;
    sum.aliased += expected.aliased;
  }
  EXPECT_EQ(table.sharing().same_cell, sum.same_cell);
  EXPECT_EQ(table.sharing().aliased, sum.aliased);
}

INSTANTIATE_TEST_SUITE_P(Methods, TableContentsOf,
                         testing::Combine(testing::Values("multi-level-sb", "grid-hash", "bounding-box-grid-hash"),
                                          testing::Values(1u, 7u, 1001u), testing::Values(0.1f, 0.8f)));

TEST(BucketContents, ReturnTheGroupOfACellOrTheFullestIfThereIsAny) {
  const compare::BucketContents bucket{.bucket = 1, .groups = {{{0, 0, 0}, {1, 2}}, {{5, 5, 5}, {7}}}};
  EXPECT_EQ(bucket.group(std::nullopt), &bucket.groups[0]);
  EXPECT_EQ(bucket.group(compare::Cell{5, 5, 5}), &bucket.groups[1]);
  EXPECT_EQ(bucket.group(compare::Cell{9, 9, 9}), &bucket.groups[0]);
  EXPECT_EQ(compare::TableContents().bucket(3).items, 0u);
  EXPECT_EQ(compare::TableContents().bucket(3).group(std::nullopt), nullptr);
}

TEST(PaperStructure, EqualsThatOfAFullDetection) {
  const collide::Settings settings{.cell_size = glm::vec3(1.0f)};
  collide::Workers alone(1);
  const auto whole = structure(collide::paper_method, settings);
  const auto alone_built = collide::methods::make_paper_structure()(world().positions(), settings, alone);
  EXPECT_EQ(alone_built.box_bucket, whole.box_bucket);
  EXPECT_EQ(alone_built.loads, whole.loads);
  EXPECT_EQ(alone_built.cells, whole.cells);
}

}  // namespace THIS_FILE
}  // namespace app
