#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "collide/methods/bucket_table.h"
#include "collide/methods/cell_hash.h"

namespace collide::test {

using namespace collide::methods;
namespace THIS_FILE {

CellHash hash_of(std::uint32_t buckets, const glm::vec3& cell = glm::vec3(1)) {
  Settings settings;
  settings.buckets = buckets;
  settings.cell_size = cell;
  return CellHash(settings);
}

/// Worked out outside of the program with whole numbers of any length, primes 73856093, 19349669, 83492791.
TEST(CellHash, EqualsValuesComputedByHand) {
  struct Known {
    CellHash::Cell cell;
    std::array<std::uint32_t, 4> bucket;  // of 1, 101, 1001, 2^24
  };
  constexpr std::int64_t far = std::int64_t{1} << 60;
  const std::array known{
      Known{{0, 0, 0}, {0, 0, 0, 0}},
      Known{{1, 0, 0}, {0, 45, 311, 6747229}},
      Known{{0, 1, 0}, {0, 89, 339, 2572453}},
      Known{{0, 0, 1}, {0, 30, 382, 16383927}},
      Known{{-1, -1, -1}, {0, 38, 970, 7850823}},
      Known{{2, 0, -3}, {0, 0, 477, 14674325}},
      Known{{-5, 7, 11}, {0, 21, 15, 13499279}},
      Known{{far, -far, far}, {0, 95, 354, 0}},
  };
  for (const Known& k : known) {
    EXPECT_EQ(hash_of(1).bucket(k.cell), k.bucket[0]);
    EXPECT_EQ(hash_of(101).bucket(k.cell), k.bucket[1]);
    EXPECT_EQ(hash_of(1001).bucket(k.cell), k.bucket[2]);
    EXPECT_EQ(hash_of(1u << 24).bucket(k.cell), k.bucket[3]);
  }
}

TEST(CellHash, DoesNotOverflowWithTheLargestPrimesAndCounts) {
  Settings settings;
  settings.cell_size = glm::vec3(1);
  settings.buckets = max_buckets - 1;  // 2^24 - 1, so 2^32 - 1 = 255 modulo it
  settings.primes = {0xffffffffu, 0xffffffffu, 0xffffffffu};
  const std::int64_t last = settings.buckets - 1;  // -1 modulo the count
  EXPECT_EQ(CellHash(settings).bucket({last, last, last}), settings.buckets - 3 * 255);
}

TEST(CellHash, AliasesCellsABucketCountApart) {
  const CellHash hash = hash_of(101);
  for (std::int64_t i = -300; i < 300; i += 7) {
    EXPECT_EQ(hash.bucket({i, 3, -8}), hash.bucket({i + 101, 3, -8}));
    EXPECT_EQ(hash.bucket({5, i, -8}), hash.bucket({5, i - 202, -8}));
  }
}

TEST(CellHash, TakesTheFloorOfTheQuotient) {
  const CellHash hash = hash_of(101, glm::vec3(0.5f, 2, 1e-6f));
  EXPECT_EQ(hash.cell(0, 0, 0), (CellHash::Cell{0, 0, 0}));
  EXPECT_EQ(hash.cell(0.5, 1.999, 0), (CellHash::Cell{1, 0, 0}));
  EXPECT_EQ(hash.cell(-0.5, -2, 0), (CellHash::Cell{-1, -1, 0}));
  EXPECT_EQ(hash.cell(-0.501, -1e-30, 0), (CellHash::Cell{-2, -1, 0}));
  EXPECT_EQ(hash.index(0, 1e6), 2'000'000);
}

TEST(CellHash, ClampsWhatNoIntegerHolds) {
  const CellHash hash = hash_of(101, glm::vec3(1e-30f));
  constexpr std::int64_t limit = std::int64_t{1} << 60;
  EXPECT_EQ(hash.index(0, 1e38), limit);
  EXPECT_EQ(hash.index(1, -1e38), -limit);
  EXPECT_EQ(hash.index(2, std::numeric_limits<double>::infinity()), limit);
}

TEST(CellRange, CountsAndVisitsItsCellsMinimumFirst) {
  const CellRange range{{-1, 4, 0}, {0, 4, 2}};
  std::vector<CellHash::Cell> visited;
  range.for_each([&](const CellHash::Cell& cell) { visited.push_back(cell); });
  EXPECT_EQ(range.count(), 6.0);
  EXPECT_EQ(visited.size(), 6u);
  EXPECT_EQ(visited.front(), range.lo);
  EXPECT_EQ(visited.back(), range.hi);
  constexpr std::int64_t limit = std::int64_t{1} << 60;
  EXPECT_GT((CellRange{{-limit, -limit, -limit}, {limit, limit, limit}}.count()), 0x1p182);
}

TEST(CellRange, IsListedInAtLeast27CellsAndInMoreWhileThereIsRoom) {
  for (const double vertices : {1.0, 1e4, 1e7, 4e9}) {
    EXPECT_EQ(max_listed_cells(vertices, 0), 27);
    EXPECT_EQ(max_listed_cells(vertices, 50), 50);
    EXPECT_EQ(max_listed_cells(vertices), std::clamp(vertices / 32, 64.0, room_for_cells));
  }
}

TEST(BucketTable, SortsEntriesAndKeepsTheirOrder) {
  const std::vector<std::uint32_t> bucket{3, 0, 3, 1, 3};
  BucketTable table;
  table.build(bucket, 5);
  EXPECT_EQ(table.loads(), (std::vector<BucketLoad>{{3, 3}, {0, 1}, {1, 1}}));
  EXPECT_EQ(table.slot(0), 0u);
  EXPECT_EQ(table.slot(2), 1u);
  EXPECT_EQ(table.slot(4), 2u);
  EXPECT_EQ(table.slot(1), 3u);
  EXPECT_EQ(table.slot(3), 4u);
  EXPECT_EQ(table.slots(3).begin, 0u);
  EXPECT_EQ(table.slots(3).end, 3u);
  EXPECT_EQ(table.slots(2).begin, table.slots(2).end);
  table.build({}, 2);
  EXPECT_TRUE(table.loads().empty());
  EXPECT_EQ(table.buckets(), 2u);
}

TEST(BucketTable, GivesALargeTableBack) {
  const std::vector<std::uint32_t> bucket{3, 0, 3};
  BucketTable table;
  table.build(bucket, max_buckets);
  EXPECT_GE(table.bytes(), std::size_t{4} * max_buckets);
  table.build(bucket, 101);
  EXPECT_LE(table.bytes(), 10'000u);
}

TEST(BucketTable, ForgetsTheTableBefore) {
  std::mt19937 random(3);
  BucketTable table;
  for (const std::uint32_t buckets : {7u, 7u, 1000u, 1000u, 3u, 3u, 1u, 7u}) {
    std::vector<std::uint32_t> bucket(random() % 200);
    for (std::uint32_t& b : bucket) b = random() % buckets;
    table.build(bucket, buckets);
    for (std::uint32_t b = 0; b < buckets; ++b) {
      std::uint32_t slot = table.slots(b).begin;
      for (std::size_t e = 0; e < bucket.size(); ++e)
        if (bucket[e] == b) {
          EXPECT_EQ(table.slot(e), slot++);
        }
      EXPECT_EQ(table.slots(b).end, slot);
    }
  }
}

}  // namespace THIS_FILE
}  // namespace collide::test
