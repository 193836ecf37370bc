// Bodies beside, on and over solids that are thin or sharp, by surface contact: nothing moves them but what touches
// them, and they come to rest.

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "softbody/contact/keys.h"
#include "softbody/forces/springs.h"
#include "tests/softbody/surface_rig.h"

namespace softbody::test {
namespace THIS_FILE {

constexpr double g = 9.81;

glm::dmat3 turned(const glm::dvec3& axis, double degrees) {
  return glm::dmat3(glm::rotate(glm::dmat4(1.0), glm::radians(degrees), axis));
}

Scene cloth(double size, double mass) {
  Material m;
  m[Material::mass] = mass;
  m.set(StructuralSprings::keys, {200, 0.1});
  m.set(BendSprings::keys, {1, 0.1});
  m.set(ShearSprings::keys, {50, 0.1});
  m[Material::internal_damping] = 2;
  Scene scene = ball_in_space(m);
  scene.gravity = {0, -g, 0};
  set_solid(scene, {Ground{}});
  scene.sleep.speed = 0.03;
  scene.bodies[0].mesh = {.kind = "grid", .columns = 12, .rows = 12, .width = size, .depth = size};
  scene.bodies[0].position = {0.03, 1.2, 0.02};
  return scene;
}

Scene ball() {
  Scene scene = ball_in_space(damped(rubber()));
  scene.gravity = {0, -g, 0};
  set_solid(scene, {Ground{-3}});
  scene.sleep.speed = 0.03;
  scene.bodies[0].position = {0, 1.56, 0};
  return scene;
}

struct Case {
  const char* name;
  Scene scene;
  int frames;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

Case with(Case c, const SolidBox& box) {
  set_solid(c.scene, {box});
  return c;
}

class ThinSolid : public testing::TestWithParam<Case> {};

/// Energy: kinetic, of springs and gas, and of gravity. What comes nearer than the thickness may be lifted by it.
TEST_P(ThinSolid, BringsToRestWithoutEnergyFromNowhere) {
  World world(GetParam().scene, {});
  const Material& m = world.model(0).material;
  const double lift = m[Material::mass] * g * m[Material::thickness];
  double least = measure(world).energy;
  for (int i = 0; i < GetParam().frames && !(i > 0 && world.all_at_rest()); ++i) {
    world.step();
    const double energy = measure(world).energy;
    ASSERT_LT(energy, least + lift) << frame_of(world);
    least = std::min(least, energy);
  }
  EXPECT_TRUE(world.all_at_rest()) << measure(world).max_speed << " m/s";
}

INSTANTIATE_TEST_SUITE_P(
    Under, ThinSolid,
    testing::Values(
        with({"BallOnAPlank", ball(), 300}, {.centre = {0, 1, 0}, .half_size = {1, 0.025, 0.15}}),
        with({"BallOnATurnedPlank", ball(), 300},
             {.centre = {0, 1, 0}, .half_size = {0.2, 0.01, 0.8}, .axes = turned({0, 1, 0}, 40)}),
        with({"ClothOnATable", cloth(2, 0.3), 900}, {.centre = {0, 0.975, 0}, .half_size = {0.5, 0.025, 0.5}}),
        with({"ClothOverAPost", cloth(2, 0.3), 900}, {.centre = {0, 0.5, 0}, .half_size = {0.01, 0.5, 0.01}}),
        with({"ClothOverARail", cloth(1.5, 0.4), 900}, {.centre = {0, 0.7, 0}, .half_size = {0.5, 0.01, 0.015}}),
        with({"ClothOnACorner", cloth(2, 0.3), 900}, {.centre = {0, 0.3, 0},
                                                      .half_size = glm::dvec3(0.5),
                                                      .axes = turned(glm::normalize(glm::dvec3(1, 0, -1)), 54.7)}),
        with({"ClothOnABlock", cloth(1.4, 0.9), 900}, {.centre = {0, 0.5, 0}, .half_size = {0.19, 0.5, 0.28}})),
    [](const auto& i) { return std::string(i.param.name); });

/// A quad beside a post or a rod, without gravity. Nothing touches it.
TEST(ThinSolidAlone, MovesNothingThatIsBesideIt) {
  const auto beside = [](const glm::dvec3& at) {
    Scene scene = ball_in_space(rubber());
    scene.bodies[0].mesh = {.kind = "grid", .columns = 1, .rows = 1, .width = 0.2, .depth = 0.4};
    scene.bodies[0].position = at;
    return scene;
  };
  const SolidBox flat{.half_size = {1, 0.01, 0.01}};
  for (const double height : {0.03, 0.016, -0.03, 0.2}) {
    for (const double degrees : {0.0, 17.0, 45.0}) {
      Scene scene = beside({0.02, height, 0.01});
      set_solid(scene, {flat});
      shape_of<SolidBox>(scene).axes = turned({0, 1, 0}, degrees);
      World world(scene, {});
      run(world, 60);
      EXPECT_LT(measure(world).max_speed, 1e-4) << height << " m above, " << degrees << " degrees";
      EXPECT_NEAR(motion(world, 0).centre.y, height, 1e-6);
    }
  }
}

}  // namespace THIS_FILE
}  // namespace softbody::test
