#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "app/base/heap.h"
#include "collide/methods/bucket_table.h"
#include "collide/methods/cell_hash.h"

namespace collide::test {

using namespace collide::methods;
namespace THIS_FILE {

CellHash hash_of(std::uint32_t buckets, const glm::vec3& cell = glm::vec3(1)) {
  return CellHash({.buckets = buckets, .cell_size = cell});
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
  Settings settings{.cell_size = glm::vec3(1)};
  settings.buckets = max_buckets - 1;  // 2^24 - 1, so 2^32 - 1 = 255 modulo it
  settings.primes = {0xffffffffu, 0xffffffffu, 0xffffffffu};
  const std::int64_t last = settings.buckets - 1;  // -1 modulo the count
  EXPECT_EQ(CellHash(settings).bucket({last, last, last}), settings.buckets - 3 * 255);
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
  EXPECT_GT((CellRange{{-limit, -limit, -limit}, {limit, limit, limit}}.count()), 0x1p182);
}

TEST(MaxListedCells, IsAThirtySecondOfTheVerticesWithinItsBounds) {
  EXPECT_EQ(max_listed_cells(100), 64.0);
  EXPECT_EQ(max_listed_cells(6400), 200.0);
  EXPECT_EQ(max_listed_cells(6400, 1), 27.0);
}

TEST(BucketTable, GivesALargeTableBack) {
  const std::vector<std::uint32_t> bucket{3, 0, 3};
  BucketTable table;
  const std::size_t before = app::heap_in_use();  // always 0 where the C library does not report it
  table.build(bucket, max_buckets);
  table.build(bucket, 101);
  EXPECT_LE(app::heap_in_use(), before + 10'000);
}

}  // namespace THIS_FILE
}  // namespace collide::test
