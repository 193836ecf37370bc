#include "app/session/undo_history.h"

#include <gtest/gtest.h>

#include "softbody/world.h"
#include "tests/app/scenes.h"

namespace app {
namespace {

session::PastWorld past(int frame) {
  const softbody::Scene scene = touching_pair();
  softbody::World world(scene, {});
  while (world.frame() < frame) world.step();
  return {world.snapshot(), {scene, session::SceneFile("pair", scene), session::list_solids(scene)}};
}

TEST(UndoHistory, KeepsTheLatestFew) {
  session::UndoHistory history;
  for (int frame = 0; frame < 10; ++frame) history.push(past(frame));
  EXPECT_EQ(history.count(), session::UndoHistory::max_count);
  EXPECT_EQ(history.last().snapshot.frame, 9);
  while (history.count() > 1) history.pop();
  EXPECT_EQ(history.last().snapshot.frame, 2);
  history.pop();
  EXPECT_TRUE(history.empty());
  EXPECT_EQ(history.bytes(), 0u);
}

TEST(UndoHistory, KeepsWithinABoundOfMemoryButNeverForgetsTheLast) {
  const std::size_t one = past(0).snapshot.bytes();
  session::UndoHistory three(7 * one / 2), none(one / 2);
  for (int frame = 0; frame < 6; ++frame) {
    three.push(past(frame));
    none.push(past(frame));
    EXPECT_EQ(three.last().snapshot.frame, frame);
    EXPECT_EQ(none.last().snapshot.frame, frame);
  }
  EXPECT_EQ(three.count(), 3u);
  EXPECT_LE(three.bytes(), 7 * one / 2);
  EXPECT_EQ(none.count(), 1u);
}

}  // namespace
}  // namespace app
