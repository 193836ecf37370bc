#include "app/session/undo_history.h"

#include <gtest/gtest.h>

#include "softbody/world/world.h"
#include "tests/app/scenes.h"

namespace app {
namespace THIS_FILE {

using session::Way;

session::KeptWorld kept(int frame) {
  const softbody::Scene scene = touching_pair();
  softbody::World world(scene, {});
  while (world.frame() < frame) world.step();
  return {world.snapshot(), {scene, session::SceneFile("pair")}, "change"};
}

const softbody::Snapshot& snapshot_of(const session::KeptWorld& kept) {
  return std::get<softbody::Snapshot>(kept.world);
}

int next_frame(const session::UndoHistory& history, Way way) { return snapshot_of(history.next(way)).frame; }

TEST(UndoHistory, KeepsWithinABoundOfMemoryButNeverForgetsTheLast) {
  const std::size_t one = snapshot_of(kept(0)).bytes();
  session::UndoHistory three(7 * one / 2), none(one / 2);
  for (int frame = 0; frame < 6; ++frame) {
    for (session::UndoHistory* history : {&three, &none}) {
      history->push(kept(frame));
      EXPECT_EQ(next_frame(*history, Way::back), frame);
    }
  }
  EXPECT_EQ(three.count(), 3u);
  EXPECT_LE(three.bytes(), 7 * one / 2);
  EXPECT_EQ(none.count(), 1u);
  for (session::UndoHistory* history : {&three, &none}) {
    history->turn(Way::back, kept(6));
    EXPECT_EQ(next_frame(*history, Way::forward), 6);
  }
  EXPECT_EQ(three.count(), 3u);
  EXPECT_LE(three.bytes(), 7 * one / 2);
  EXPECT_TRUE(none.empty(Way::back));
}

/// Worlds after a change may take more memory than those before it.
TEST(UndoHistory, KeepsWithinTheBoundWhenItTurns) {
  session::KeptWorld large = kept(0);
  softbody::World world(touching_pair(), {});
  world.drop(20);
  large.world = world.snapshot();
  const std::size_t small = snapshot_of(kept(0)).bytes();
  ASSERT_GT(snapshot_of(large).bytes(), 3 * small);
  session::UndoHistory history(snapshot_of(large).bytes() + small / 2);
  history.push(kept(0));
  history.push(kept(1));
  history.turn(Way::back, large);
  EXPECT_FALSE(history.empty(Way::forward));
  EXPECT_TRUE(history.empty(Way::back)) << "the world just left is kept, the oldest is not";
}

}  // namespace THIS_FILE
}  // namespace app
