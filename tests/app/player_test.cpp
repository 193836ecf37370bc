// A recording is played: its frames are shown to the bit.

#include "app/session/player.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/app/recorded_bodies.h"
#include "tests/app/scenes.h"

namespace app {
namespace THIS_FILE {

class PlayerTest : public testing::Test {
 protected:
  /// Expects that the player shows a frame to the bit, and that its contacts are those of brute force.
  void expect_frame(int number) {
    ASSERT_EQ(player.frame(), number);
    const std::shared_ptr<const files::RecordedFrame> recorded = balls->frame(number);
    ASSERT_EQ(player.bodies().count(), recorded->body_count);
    const collide::Frame at = player.positions();
    EXPECT_TRUE(std::ranges::equal(at.x, recorded->x) && std::ranges::equal(at.y, recorded->y) &&
                std::ranges::equal(at.z, recorded->z))
        << number;
    EXPECT_EQ(player.detection().contacts, true_contacts(player)) << number;
  }

  std::shared_ptr<RecordedBalls> balls = std::make_shared<RecordedBalls>(8);
  session::Player player{balls, opened(balls).scene, 1};
};

TEST_F(PlayerTest, ShowsFrameAfterFrameOrAnyFrame) {
  expect_frame(0);
  bool touched = false;
  for (int i = 1; i < 20; ++i) {
    player.step();
    expect_frame(i % 8);
    touched = touched || !player.detection().contacts.empty();
  }
  EXPECT_TRUE(touched);
  EXPECT_NEAR(player.last_step().time, 19.0 / 60, 1e-9) << "time goes on";
  for (const int frame : {5, 2, 7, 0, 4}) {
    player.show(frame);
    expect_frame(frame);
  }
  player.step();
  expect_frame(5);
}

TEST_F(PlayerTest, HasTheCellSizeOfItsFirstFrameWhateverItShows) {
  const glm::vec3 at_start = *player.collision().cell_size;
  collide::Settings settings = player.collision();
  EXPECT_EQ(at_start, collide::automatic_cell_size(player.positions(), settings.levels, settings.tolerance));
  player.show(6);
  player.apply(player.scene());
  EXPECT_EQ(player.collision().cell_size, at_start);
  EXPECT_EQ(player.automatic_cell_size(settings.levels), at_start);
  EXPECT_LT(player.automatic_cell_size(9).x, player.automatic_cell_size(0).x);
}

TEST_F(PlayerTest, IsAtRestIfThereIsNoOtherFrame) {
  EXPECT_FALSE(player.all_at_rest());
  const auto one = std::make_shared<RecordedBalls>(1);
  EXPECT_TRUE(session::Player(one, opened(one).scene, 1).all_at_rest());
}

}  // namespace THIS_FILE
}  // namespace app
