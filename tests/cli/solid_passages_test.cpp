// Passages of bodies through solids, as the reports count them.

#include "app/report/solid_passages.h"

#include <gtest/gtest.h>

#include <limits>

#include "app/report/worlds.h"
#include "tests/solids.h"

namespace app::test {
namespace THIS_FILE {

using glm::dvec3;

class SolidPassages : public testing::Test {
 protected:
  static constexpr dvec3 beside{-1.5, 0.4, 0}, inside{-0.5, 0.4, 0}, above{-0.5, 1.5, 0}, opposite{1.5, 0.4, 0};

  /// Returns the passages of a ball through a box whose middle has been at these points, one look after another.
  static std::size_t count(std::initializer_list<dvec3> middles, const dvec3& half_size = dvec3(1.0)) {
    softbody::Scene scene = report::lone_scene(report::ball_material(1e3, 0.1));
    tests::set_solid(scene, {softbody::SolidBox{.half_size = half_size}});
    softbody::World world(scene, {});
    report::SolidPassages passages;
    for (const dvec3& middle : middles) {
      move(world, middle);
      EXPECT_TRUE(passages.observe(world));
    }
    return passages.count();
  }

  static void move(softbody::World& world, const dvec3& middle) {
    std::vector<softbody::Particle> particles;
    const dvec3 way = middle - report::middle_of(world, 0);
    for (collide::Index v = 0; v < world.bodies().size(0); ++v)
      particles.push_back({world.particle(0, v).position + way, dvec3(0.0)});
    world.set_particles(0, particles);
  }
};

TEST_F(SolidPassages, AreInOnOneSideAndOutOnTheOppositeOne) {
  EXPECT_EQ(count({beside, opposite}), 1u);
  EXPECT_EQ(count({beside, inside, opposite}), 1u);
  EXPECT_EQ(count({beside, inside, opposite, inside, beside}), 2u);
}

TEST_F(SolidPassages, AreNotRoundACornerNorBackOutOnTheSameSide) {
  EXPECT_EQ(count({beside, above}), 0u);
  EXPECT_EQ(count({beside, inside, above}), 0u);
  EXPECT_EQ(count({beside, inside, beside}), 0u);
  EXPECT_EQ(count({beside, above, {1.5, 1.5, 0}, opposite}), 0u) << "never in it";
}

TEST_F(SolidPassages, GoThroughAThinPlate) {
  for (const double height : {1.0, 1.01, 1.02, 1.03}) {
    const dvec3 plate(10, 0.05, 10);
    EXPECT_EQ(count({{0, height, 0}, {0, -1, 0}}, plate), 1u) << height;
    EXPECT_EQ(count({{0, height, 0}, {0, 0.1, 0}}, plate), 0u) << height;
  }
}

TEST_F(SolidPassages, SayIfAMiddleIsNotFinite) {
  softbody::World world(report::lone_scene(report::ball_material(1e3, 0.1)), {});
  report::SolidPassages passages;
  EXPECT_TRUE(passages.observe(world));
  move(world, dvec3(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(passages.observe(world));
}

}  // namespace THIS_FILE
}  // namespace app::test
