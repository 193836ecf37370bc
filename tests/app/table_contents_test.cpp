#include "app/compare/table_contents.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "collide/methods.h"
#include "collide/methods/detectors.h"
#include "tests/bucket_loads.h"

namespace app {
namespace THIS_FILE {

using collide::Index;

/// Bodies of twelve points each, at random places.
struct Points {
  explicit Points(int number) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> anywhere(-2, 2), near(-0.3f, 0.3f);
    const auto shape = std::make_shared<collide::Shape>(Index{12}, std::span<const std::array<Index, 2>>{});
    for (int b = 0; b < number; ++b) {
      const glm::vec3 centre{anywhere(random), anywhere(random), anywhere(random)};
      for (int v = 0; v < 12; ++v) {
        x.push_back(centre.x + near(random));
        y.push_back(centre.y + near(random));
        z.push_back(centre.z + near(random));
      }
      bodies.add(shape);
    }
  }
  collide::Frame frame() const { return {x, y, z, &bodies}; }

  std::vector<float> x, y, z;
  collide::Bodies bodies;
};

collide::DebugGeometry structure(std::string_view method, const Points& points, const collide::Settings& settings) {
  collide::Workers alone(1);
  collide::Result result;
  const auto detector = collide::find_method(method)->make();
  detector->detect(points.frame(), settings, alone, result);
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

class TableContentsOf : public testing::TestWithParam<std::tuple<const char*, std::uint32_t, float>> {};

TEST_P(TableContentsOf, HasTheEntriesOfEachBucket) {
  const auto [method, buckets, cell] = GetParam();
  const Points points(30);
  collide::Settings settings;
  settings.buckets = buckets;
  settings.cell_size = glm::vec3(cell);
  const collide::DebugGeometry debug = structure(method, points, settings);
  const compare::TableContents table(debug, points.frame(), settings);
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

TEST(TableContents, HasNoGroupInAnEmptyBucket) {
  const compare::TableContents table;
  EXPECT_EQ(table.bucket(3).items, 0u);
  EXPECT_EQ(table.bucket(3).group(std::nullopt), nullptr);
}

TEST(TableContents, ReturnsTheGroupOfACellOrTheFullest) {
  const compare::BucketContents bucket{.bucket = 1, .groups = {{{0, 0, 0}, {1, 2}}, {{5, 5, 5}, {7}}}};
  EXPECT_EQ(bucket.group(std::nullopt), &bucket.groups[0]);
  EXPECT_EQ(bucket.group(compare::Cell{5, 5, 5}), &bucket.groups[1]);
  EXPECT_EQ(bucket.group(compare::Cell{9, 9, 9}), &bucket.groups[0]);
}

TEST(PaperStructure, EqualsThatOfAFullDetection) {
  const Points points(30);
  const collide::Settings settings{.cell_size = glm::vec3(1.0f)};
  collide::Workers alone(1);
  const auto whole = structure(collide::paper_method, points, settings);
  const auto alone_built = collide::methods::make_paper_structure()(points.frame(), settings, alone);
  EXPECT_EQ(alone_built.box_bucket, whole.box_bucket);
  EXPECT_EQ(alone_built.loads, whole.loads);
  EXPECT_EQ(alone_built.cells, whole.cells);
}

}  // namespace THIS_FILE
}  // namespace app
