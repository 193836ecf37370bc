#include <gtest/gtest.h>

#include "app/ui/widgets/bucket_grid.h"
#include "collide/core/detector.h"

namespace app {
namespace THIS_FILE {

class BucketGridTest : public testing::TestWithParam<std::uint32_t> {};

TEST_P(BucketGridTest, HoldsEveryBucketOnceInsideItsArea) {
  const ui::BucketGrid grid = ui::BucketGrid::fit(GetParam(), 250, 170, 4);
  EXPECT_GE(grid.side, 4);
  EXPECT_LE(static_cast<float>(grid.columns) * grid.side, 250);
  EXPECT_LE(static_cast<float>(grid.rows) * grid.side, 170);
  EXPECT_GE(grid.columns * grid.rows, grid.squares());
  EXPECT_EQ(grid.first_bucket(0), 0u);
  EXPECT_EQ(grid.last_bucket(grid.squares() - 1), GetParam() - 1);
  for (std::uint32_t s = 1; s < grid.squares(); ++s) ASSERT_EQ(grid.first_bucket(s), grid.last_bucket(s - 1) + 1);
}

TEST_P(BucketGridTest, FindsTheSquareUnderTheMouse) {
  const ui::BucketGrid grid = ui::BucketGrid::fit(GetParam(), 250, 170, 4);
  for (std::uint32_t s = 0; s < grid.squares(); ++s) {
    const float x = (static_cast<float>(s % grid.columns) + 0.5f) * grid.side;
    const float y = (static_cast<float>(s / grid.columns) + 0.5f) * grid.side;
    ASSERT_EQ(grid.square_at(x, y), s);
  }
  EXPECT_EQ(grid.square_at(-1, 3), std::nullopt);
  EXPECT_EQ(grid.square_at(3, 1e9f), std::nullopt);
}

INSTANTIATE_TEST_SUITE_P(Counts, BucketGridTest,
                         testing::Values(1u, 2u, 3u, 101u, 499u, 1001u, 2604u, 2605u, 100'003u, collide::max_buckets));

TEST(BucketGrid, SharesSquaresOnlyWhenBucketsAreTooMany) {
  EXPECT_EQ(ui::BucketGrid::fit(1001, 250, 170, 4).per_square, 1u);
  EXPECT_GT(ui::BucketGrid::fit(collide::max_buckets, 250, 170, 4).per_square, 1u);
}

}  // namespace THIS_FILE
}  // namespace app
