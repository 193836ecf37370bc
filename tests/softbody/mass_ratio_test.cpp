// A body that is many times as heavy as the one that it falls on, by surface contact.

#include <gtest/gtest.h>

#include "tests/softbody/surface_rig.h"

namespace softbody::test {
namespace THIS_FILE {

struct HeavyCase {
  const char* name;
  double ratio;  // of the masses, and of the springs
  glm::dvec3 position;
  bool in_a_well = false;
};
void PrintTo(const HeavyCase& c, std::ostream* out) { *out << c.name; }

class HeavyBall : public testing::TestWithParam<HeavyCase> {};

TEST_P(HeavyBall, DoesNotOverlapTheLightOneThatItFallsOn) {
  const HeavyCase& c = GetParam();
  Material light = rubber();
  light[Material::internal_damping] = 10;
  light[contact::rebound_speed] = 2;
  Scene scene = ball_in_space(light);
  scene.gravity = {0, -9.81, 0};
  set_solid(scene, {Ground{}});
  scene.bodies[0].position = {0, 0.53, 0};
  Material heavy = light;
  heavy[Material::mass] *= c.ratio;
  heavy.set(StructuralSprings::keys, {200 * c.ratio, 0.1});
  heavy.set(BendSprings::keys, {50 * c.ratio, 0.1});
  scene.materials.push_back(heavy);
  add_body(scene, c.position, glm::dvec3(0.0));
  scene.bodies[1].material = 1;
  if (c.in_a_well)
    for (const glm::dvec3& inwards :
         {glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1)})
      add_solid(scene, {SolidPlane{-0.6 * inwards, inwards}, 0.3, 0});
  World world(scene, {});
  Judge judge(world);
  const double lift = 0.002 * c.ratio * glm::length(scene.gravity);  // J: the heavy one by 2 mm
  double least = measure(world).energy, smallest = 1;
  for (int i = 0; i < 60; ++i) {
    world.step();
    if (i % 5 == 0) judge.expect_clean(frame_of(world));
    const Measures m = measure(world);
    ASSERT_LT(m.energy, least + lift) << frame_of(world);
    least = std::min(least, m.energy);
    smallest = std::min(smallest, m.volume_ratio_min);
  }
  EXPECT_LT(smallest, 0.995) << "it was crushed";
}

INSTANTIATE_TEST_SUITE_P(Of, HeavyBall,
                         testing::Values(HeavyCase{"ThirtyTimes", 30, {0, 1.6, 0}},
                                         HeavyCase{"HundredTimesBesideTheMiddle", 100, {0.15, 1.6, 0.05}},
                                         HeavyCase{"HundredTimesInAWell", 100, {0.02, 1.7, 0}, true},
                                         HeavyCase{"ThreeHundredTimesInAWell", 300, {0.02, 1.7, 0.01}, true}),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace THIS_FILE
}  // namespace softbody::test
