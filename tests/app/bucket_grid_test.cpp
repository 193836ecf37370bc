#include <gtest/gtest.h>

#include "app/ui/widgets/bucket_grid.h"
#include "collide/core/detector.h"

namespace app {
namespace THIS_FILE {

TEST(BucketGrid, HoldsEveryBucketOnceInsideItsAreaAndFindsTheSquareUnderTheMouse) {
  for (const std::uint32_t buckets :
       {1u, 2u, 3u, 101u, 499u, 1001u, 2604u, 2605u, 100'003u, std::uint32_t{collide::max_buckets}}) {
    const ui::BucketGrid grid = ui::BucketGrid::fit(buckets, 250, 170, 4);
    EXPECT_GE(grid.side, 4);
    EXPECT_EQ(grid.per_square == 1, buckets <= 62 * 42) << "squares are shared only when buckets are too many";
    EXPECT_LE(static_cast<float>(grid.columns) * grid.side, 250);
    EXPECT_LE(static_cast<float>(grid.rows) * grid.side, 170);
    EXPECT_GE(grid.columns * grid.rows, grid.squares());
    EXPECT_EQ(grid.first_bucket(0), 0u);
    EXPECT_EQ(grid.last_bucket(grid.squares() - 1), buckets - 1);
    for (std::uint32_t s = 0; s < grid.squares(); ++s) {
      if (s > 0) {
        ASSERT_EQ(grid.first_bucket(s), grid.last_bucket(s - 1) + 1);
      }
      const float x = (static_cast<float>(s % grid.columns) + 0.5f) * grid.side;
      const float y = (static_cast<float>(s / grid.columns) + 0.5f) * grid.side;
      ASSERT_EQ(grid.square_at(x, y), s);
    }
    EXPECT_EQ(grid.square_at(-1, 3), std::nullopt);
    EXPECT_EQ(grid.square_at(3, 1e9f), std::nullopt);
  }
}

}  // namespace THIS_FILE
}  // namespace app
