// Passages of bodies through solids, as the reports count them.

#include "app/report/solid_passages.h"

#include <gtest/gtest.h>

#include <limits>

#include "app/report/worlds.h"
#include "tests/solids.h"

namespace app::test {
namespace THIS_FILE {

using glm::dvec3;

void move(softbody::World& world, const dvec3& middle) {
  std::vector<softbody::Particle> particles;
  const dvec3 way = middle - report::middle_of(world.positions(), 0);
  for (collide::Index v = 0; v < world.bodies().size(0); ++v)
    particles.push_back({world.particle(0, v).position + way, dvec3(0.0)});
  world.set_particles(0, particles);
}

TEST(SolidPassages, AreInOnOneSideAndOutOnTheOppositeOne) {
  constexpr dvec3 beside{-1.5, 0.4, 0}, inside{-0.5, 0.4, 0}, above{-0.5, 1.5, 0}, opposite{1.5, 0.4, 0};
  const dvec3 cube(1.0), plate(10, 0.05, 10);
  struct Case {
    const char* what;
    dvec3 half_size;             // of a box
    std::vector<dvec3> middles;  // of a ball, one look after another
    std::size_t passages;
  };
  std::vector<Case> cases{{"in one step", cube, {beside, opposite}, 1},
                          {"in two steps", cube, {beside, inside, opposite}, 1},
                          {"and back", cube, {beside, inside, opposite, inside, beside}, 2},
                          {"round a corner in one step", cube, {beside, above}, 0},
                          {"round a corner", cube, {beside, inside, above}, 0},
                          {"out on the same side", cube, {beside, inside, beside}, 0},
                          {"never in it", cube, {beside, above, {1.5, 1.5, 0}, opposite}, 0}};
  for (const double height : {1.0, 1.01, 1.02, 1.03}) {
    cases.push_back({"through a thin plate", plate, {{0, height, 0}, {0, -1, 0}}, 1});
    cases.push_back({"above a thin plate", plate, {{0, height, 0}, {0, 0.1, 0}}, 0});
  }
  for (const auto& [what, half_size, middles, expected] : cases) {
    softbody::Scene scene = report::lone_scene(report::ball_material(1e3, 0.1));
    tests::set_solid(scene, {softbody::SolidBox{.half_size = half_size}});
    softbody::World world(scene, {});
    report::SolidPassages passages;
    for (const dvec3& middle : middles) {
      move(world, middle);
      EXPECT_TRUE(passages.observe(world)) << what;
    }
    EXPECT_EQ(passages.count(), expected) << what;
  }
}

TEST(SolidPassages, SayIfAMiddleIsNotFinite) {
  softbody::World world(report::lone_scene(report::ball_material(1e3, 0.1)), {});
  report::SolidPassages passages;
  EXPECT_TRUE(passages.observe(world));
  move(world, dvec3(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(passages.observe(world));
}

}  // namespace THIS_FILE
}  // namespace app::test
