// Bodies on planes, boxes and capsules: restitution by closed forms, rest in a groove, and no way through.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

constexpr double g = 9.81, thrown = 100;    // m/s^2, m/s
const double deepest_allowed = 0.02 * 0.5;  // m, of bodies of 0.5 m

/// Energies (J) of a ball without dampers before and after a bounce off something smooth.
struct BallBounce {
  double before, after, rise;
};
BallBounce bounce(const std::string& integrator, double restitution, bool of_material, const Scene& onto) {
  Material m = spring_ball();
  for (const Key* damping : {&StructuralSprings::damping_ratio, &BendSprings::damping_ratio}) m[*damping] = 0;
  m[contact::rebound_speed] = 1;
  m[contact::restitution] = of_material ? restitution : 0;
  Scene scene = lone_body(m, {0, -6, 0});
  scene.bodies[0].position = {0, 0.6, 0};
  scene.solids = onto.solids;
  if (!of_material) scene.solids[0].restitution = restitution;
  World world(scene, {.integrator = {integrator, std::nullopt}});
  const double before = measure(world).energy;
  for (int i = 0; i < 200 && (i < 20 || !solid_contacts(world).empty()); ++i) world.step();
  run(world, 3);
  return {before, measure(world).energy, motion(world, 0).velocity.y};
}

/// At 1 it takes none, from the energy that moves and the one that deforms together.
TEST(Restitution, ReturnsItsSquareOfTheEnergyThatContactTakes) {
  Scene flat, round;
  set_solid(flat, {Ground{0}, 0});
  set_solid(round, {.shape = SolidSphere{.centre = {0, -1, 0}, .radius = 1}, .friction = 0});
  for (const char* integrator : {"semi-implicit-euler", "velocity-verlet", "rk4", "imex-euler"})
    for (const Scene* onto : {&flat, &round}) {
      const BallBounce lost = bounce(integrator, 0, false, *onto);
      double rise = lost.rise;
      for (const double e : {0.5, 1.0})
        for (const bool of_material : {false, true}) {
          const BallBounce kept = bounce(integrator, e, of_material, *onto);
          EXPECT_NEAR(kept.after, lost.after + e * e * (kept.before - lost.after), 0.06 * kept.before)
              << integrator << " " << e << (onto == &flat ? " flat" : " round");
          EXPECT_GE(kept.rise, rise - 1e-3);
          rise = kept.rise;
        }
    }
}

TEST(Restitution, DoesNotShakeABallAtRest) {
  Material m = gas_ball();
  m[contact::rebound_speed] = 2;
  m[Material::internal_damping] = 10;
  Scene scene = lone_body(m);
  scene.gravity = {0, -g, 0};
  scene.bodies[0].position = {0, 0.55, 0};
  // A groove of 70 degrees, in which one plane's impulse drives particles into the other.
  for (const double side : {-1.0, 1.0})
    add_solid(scene, {.shape = SolidPlane{.normal = {side * std::cos(0.61), std::sin(0.61), 0}},
                      .friction = 0.3,
                      .restitution = 0.9});
  World world(scene, {});
  run(world, 600);
  EXPECT_LT(measure(world).max_speed, 0.02);
  EXPECT_LT(measure(world).deepest_penetration, 1e-4);
}

struct Target {
  const char* name;
  std::vector<Solid> solids;  // about the origin, that span x and z
  double below;               // m: where a body that went through would come out
};

/// A grate that no mesh of 162 vertices fits through.
std::vector<Solid> grate() {
  std::vector<Solid> capsules;
  for (int i = -20; i <= 20; ++i)
    capsules.push_back({SolidCapsule{.from = {0.1 * i, 0, -3}, .to = {0.1 * i, 0, 3}, .radius = 0.045}});
  return capsules;
}

/// Of four sides, two of which drive particles into one another.
std::vector<Solid> pit() {
  std::vector<Solid> planes;
  for (const glm::dvec3& normal :
       {glm::dvec3(0.8, 0.6, 0), glm::dvec3(-0.8, 0.6, 0), glm::dvec3(0, 0.6, 0.8), glm::dvec3(0, 0.6, -0.8)})
    planes.push_back({SolidPlane{.point = {0, -1, 0}, .normal = normal}});
  return planes;
}

const glm::dmat3 tilted(glm::dvec3(0.8, 0.6, 0), glm::dvec3(-0.6, 0.8, 0), glm::dvec3(0, 0, 1));
const Target targets[]{
    {"plane", {{SolidPlane{.normal = {0.28, 0.96, 0}}}}, -3},
    {"plate", {{SolidBox{.half_size = {3, 0.025, 3}}}}, -0.6},
    {"tilted_plate", {{SolidBox{.half_size = {4, 0.025, 4}, .axes = tilted}}}, -4},
    {"capsules", grate(), -0.6},
    {"sphere", {{SolidSphere{.centre = {0, -2, 0}, .radius = 2}}}, -3},
    {"pit", pit(), -1},
};

class FastImpact : public testing::TestWithParam<Target> {};

/// Straight down without restitution, and across with it.
TEST_P(FastImpact, GoesNeitherInNorThroughAndDoesNotExplode) {
  for (const auto& [direction, restitution] :
       {std::pair(glm::dvec3(0, -1, 0), 0.0), std::pair(glm::dvec3(0.48, -0.8, 0.36), 0.5)}) {
    Material m = gas_ball();
    m[Material::thickness] = 0.005;
    Scene scene = lone_body(m, thrown * direction);
    scene.gravity = {0, -g, 0};
    scene.bodies[0].position = glm::dvec3(0.03, 0.1, 0.02) - 3.0 * direction;
    scene.solids = GetParam().solids;
    for (Solid& s : scene.solids) s.restitution = restitution;
    World world(scene, {});
    for (int i = 0; i < 20; ++i) {
      world.step();
      const Measures now = measure(world);
      ASSERT_TRUE(now.finite);
      ASSERT_LT(now.deepest_penetration, deepest_allowed) << "frame " << i;
      ASSERT_LT(now.max_speed, 3 * thrown) << "frame " << i;
      if (i < 6) {
        ASSERT_GT(motion(world, 0).centre.y, GetParam().below) << "frame " << i;
      }
    }
    EXPECT_GT(glm::distance(motion(world, 0).velocity, thrown * direction), 10) << "it met the solid";
  }
}

INSTANTIATE_TEST_SUITE_P(Solids, FastImpact, testing::ValuesIn(targets), [](const auto& i) { return i.param.name; });

}  // namespace THIS_FILE
}  // namespace softbody::test
