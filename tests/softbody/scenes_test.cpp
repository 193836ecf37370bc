// Every scene that the program ships, 800 frames: bounds that hold throughout, and rest at the end.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace {

constexpr int frames = 800;

class Scenes : public testing::TestWithParam<std::string> {};

TEST_P(Scenes, HoldTheirBoundsInEveryFrameAndSleepAtTheEnd) {
  World world(find_scene(GetParam(), SBCOLLIDE_SCENES), {.threads = 2});
  double highest = 0;
  for (const BodySource& b : world.scene().bodies) highest = std::max(highest, b.position.y);
  const double radius = world.prototype(0).radius;
  const double free_fall = std::sqrt(2 * 9.81 * (highest + radius - world.scene().ground->height));
  double fastest = 0;
  for (int frame = 1; frame <= frames; ++frame) {
    world.step();
    const Measures m = measure(world);
    ASSERT_TRUE(m.finite) << "frame " << frame;
    if (m.has_volume) {
      ASSERT_GT(m.volume_ratio_min, 0.5) << "frame " << frame;
      ASSERT_LT(m.volume_ratio_max, 2.0) << "frame " << frame;
    }
    ASSERT_LT(m.max_speed, 2 * free_fall) << "frame " << frame;
    ASSERT_LT(m.deepest_penetration, 1e-5) << "frame " << frame;
    fastest = std::max(fastest, m.max_speed);
  }
  EXPECT_GT(fastest, 0.4 * free_fall) << "they did fall";
  EXPECT_TRUE(world.all_at_rest());
  EXPECT_EQ(world.bodies().count(), world.scene().bodies.size());
  EXPECT_EQ(measure(world).max_speed, 0);
}

/// All but the one of a million faces, which takes minutes.
std::vector<std::string> small_scenes() {
  std::vector<std::string> keys = scene_keys(SBCOLLIDE_SCENES);
  std::erase(keys, "drop-3000");
  return keys;
}

INSTANTIATE_TEST_SUITE_P(All, Scenes, testing::ValuesIn(small_scenes()), [](const auto& scene) { return scene.param; });

}  // namespace
}  // namespace softbody::test
