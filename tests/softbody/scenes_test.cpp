// Bounds that hold in every frame of every scene that the program ships, until all rests; of the largest, in as many
// frames as a test can afford.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "collide/oracle/surface_oracle.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

constexpr int frames = 800;

/// Returns the speed of a fall from the highest body to the ground, m/s.
double free_fall_speed(const World& world) {
  double highest = 0;
  for (const BodySource& b : world.scene().bodies) highest = std::max(highest, b.position.y);
  return std::sqrt(2 * 9.81 * (highest + world.model(0).radius - shape_of<Ground>(world.scene()).height));
}

/// Steps through some frames, while anything moves; fails the test in the first one that is out of bounds. The fastest
/// speed of all, m/s.
void step_within_bounds(World& world, int steps, double& fastest) {
  const double free_fall = free_fall_speed(world);
  for (int i = 0; i < steps && !world.all_at_rest(); ++i) {
    world.step();
    const Measures m = measure(world);
    ASSERT_TRUE(m.finite) << "frame " << world.frame();
    if (m.has_volume) {
      ASSERT_GT(m.volume_ratio_min, 0.5) << "frame " << world.frame();
      ASSERT_LT(m.volume_ratio_max, 2.0) << "frame " << world.frame();
    }
    ASSERT_LT(m.max_speed, 2 * free_fall) << "frame " << world.frame();
    ASSERT_LT(m.deepest_penetration, 1e-5) << "frame " << world.frame();
    fastest = std::max(fastest, m.max_speed);
  }
}

class Scenes : public testing::TestWithParam<std::string> {};

TEST_P(Scenes, HoldTheirBoundsInEveryFrameAndSleepAtTheEnd) {
  World world(find_scene(GetParam(), SBCOLLIDE_SCENES), {.threads = 2});
  double fastest = 0;
  ASSERT_NO_FATAL_FAILURE(step_within_bounds(world, frames, fastest));
  EXPECT_GT(fastest, 0.4 * free_fall_speed(world)) << "they did fall";
  EXPECT_TRUE(world.all_at_rest());
  EXPECT_EQ(world.bodies().count(), world.scene().bodies.size());
  EXPECT_EQ(measure(world).max_speed, 0);
}

/// The test runs only the first second, in which the lowest bodies hit the solid sphere: 800 frames take minutes.
TEST(SceneOfAMillionFaces, HoldsItsBoundsThroughTheFirstImpacts) {
  World world(find_scene("drop-3000", SBCOLLIDE_SCENES), {.threads = 2});
  double fastest = 0;
  ASSERT_NO_FATAL_FAILURE(step_within_bounds(world, 60, fastest));
  EXPECT_GT(fastest, 5) << "they did fall";
  EXPECT_GT(solid_contacts(world).size(), 1000u);
  EXPECT_GT(world.detection().contacts.size(), 1000u);
}

/// The first turn. In all 1,200 frames of `simulate --scene wring --oracle`, too, nothing passes through anything.
TEST(SceneOfAWrungTowel, TouchesItselfAndDoesNotPassThroughItself) {
  World world(find_scene("wring", SBCOLLIDE_SCENES), {.threads = 2});
  run(world, 150);
  EXPECT_TRUE(measure(world).finite);
  EXPECT_GT(world.detection().contacts.size(), 500u);
  collide::Workers workers(2);
  EXPECT_TRUE(
      collide::oracle::find_overlaps(world.simulated().positions, {world.model(0).surface}, workers).piercings.empty());
}

/// Returns the scenes in which bodies fall to the ground, but the one of a million faces.
std::vector<std::string> small_scenes() {
  std::vector<std::string> keys = scene_keys(SBCOLLIDE_SCENES);
  std::erase_if(keys, [](const std::string& key) { return key == "drop-3000" || key == "wring"; });
  return keys;
}

INSTANTIATE_TEST_SUITE_P(All, Scenes, testing::ValuesIn(small_scenes()), [](const auto& scene) { return scene.param; });

}  // namespace THIS_FILE
}  // namespace softbody::test
