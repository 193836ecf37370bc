// A world that plays a recording: it shows its frames to the bit and simulates nothing.

#include "tests/softbody/recorded_bodies.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "softbody/world/measures.h"
#include "softbody/world/snapshot.h"
#include "softbody/world/world.h"

namespace softbody::test {
namespace {

class RecordedWorld : public testing::Test {
 protected:
  /// Expects that the world shows a frame to the bit, and that its contacts are those of brute force.
  void expect_frame(int number) {
    ASSERT_EQ(world.frame(), number);
    const std::shared_ptr<const RecordedFrame> recorded = balls->frame(number);
    ASSERT_EQ(world.bodies().count(), recorded->body_count);
    const collide::Frame at = world.positions();
    EXPECT_TRUE(std::ranges::equal(at.x, recorded->x) && std::ranges::equal(at.y, recorded->y) &&
                std::ranges::equal(at.z, recorded->z))
        << number;
    collide::Workers alone(1);
    collide::Result expected;
    collide::find_method("brute-force")->make()->detect(at, world.collision(), alone, expected);
    EXPECT_EQ(world.detection().contacts, expected.contacts) << number;
  }

  std::shared_ptr<RecordedBalls> balls = std::make_shared<RecordedBalls>(8);
  World world{scene_of(balls), {}};
};

TEST_F(RecordedWorld, ShowsFrameAfterFrameAndBeginsAgain) {
  expect_frame(0);
  bool touched = false;
  for (int i = 1; i < 20; ++i) {
    world.step();
    expect_frame(i % 8);
    touched = touched || !world.detection().contacts.empty();
  }
  EXPECT_TRUE(touched);
  EXPECT_NEAR(world.last_step().time, 19.0 / 60, 1e-9) << "time goes on";
}

TEST_F(RecordedWorld, ShowsAnyFrame) {
  for (const int frame : {5, 2, 7, 0, 4}) {
    world.show_frame(frame);
    expect_frame(frame);
  }
  world.step();
  expect_frame(5);
}

TEST_F(RecordedWorld, StaysAtItsFrameIfTheNextCannotBeRead) {
  balls->broken = 3;
  world.show_frame(2);
  EXPECT_THROW(world.step(), SceneError);
  expect_frame(2);
  world.step();
  expect_frame(4);
  world.show_frame(2);
  EXPECT_THROW(world.step(), SceneError);
  world.show_frame(1);
  world.step();
  expect_frame(2);
  EXPECT_THROW(world.show_frame(3), SceneError);
  expect_frame(2);
  world.show_frame(4);
  expect_frame(4);
}

TEST_F(RecordedWorld, LeavesOutAllStagesButDetection) {
  EXPECT_EQ(world.plan().stages, std::vector{Stage::detect});
  for (const LeftOut& one : world.plan().left_out) EXPECT_EQ(one.why, "the motion is recorded");
  collide::Settings settings = world.collision();
  settings.self_collision = false;
  world.set_collision(settings, true);
  EXPECT_TRUE(world.plan().has(Stage::detect)) << "other bodies may come";
}

TEST_F(RecordedWorld, GoesBackToASnapshotOfAnotherWorld) {
  world.show_frame(6);
  const Snapshot there = world.snapshot();
  World other(Scene(), {});
  other.restore(there);
  EXPECT_EQ(other.state_hash(), world.state_hash());
  EXPECT_EQ(other.detection().contacts, world.detection().contacts);
  other.step();
  EXPECT_EQ(other.frame(), 7);
  world.restore(World(Scene(), {}).snapshot());
  EXPECT_EQ(world.bodies().count(), 0u);
}

TEST_F(RecordedWorld, HasTheCellSizeOfItsFirstFrameWhateverItShows) {
  const glm::vec3 at_start = world.collision().cell_size;
  collide::Settings settings = world.collision();
  EXPECT_EQ(at_start, collide::default_cell_size(world.positions(), settings.levels, settings.tolerance));
  world.show_frame(6);
  world.set_collision(settings, true);
  EXPECT_EQ(world.collision().cell_size, at_start);
  EXPECT_EQ(world.default_cell_size(settings.levels), at_start);
  EXPECT_LT(world.default_cell_size(9).x, world.default_cell_size(0).x);
}

TEST_F(RecordedWorld, IsMeasuredWithoutForces) {
  world.show_frame(6);
  EXPECT_NEAR(measure(world, 2).volume_ratio, 1, 1e-5);
  EXPECT_TRUE(solid_contacts(world).empty());
  EXPECT_FALSE(world.all_at_rest());
  EXPECT_TRUE(World(scene_of(std::make_shared<RecordedBalls>(1)), {}).all_at_rest());
}

TEST_F(RecordedWorld, RefusesEveryChangeOfBodies) {
  const std::vector<Particle> particles(world.bodies().size(0));
  EXPECT_THROW(world.add(BodySource{}), SceneError);
  EXPECT_THROW(world.drop(), SceneError);
  EXPECT_THROW(world.throw_body({0, 0, 5}, {0, 0, -1}), SceneError);
  EXPECT_THROW(world.remove(0), SceneError);
  EXPECT_THROW(world.set_particles(0, particles), SceneError);
  EXPECT_THROW(world.grab(Grab{.body = 0}), SceneError);
  world.grab({});
  expect_frame(0);
}

}  // namespace
}  // namespace softbody::test
