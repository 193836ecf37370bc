// Bodies on planes, boxes and capsules: friction and restitution by closed forms, rest in corners, and no way through.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "softbody/contact/law.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

constexpr double g = 9.81, thrown = 100;    // m/s^2, m/s
const double deepest_allowed = 0.02 * 0.5;  // m, of bodies of 0.5 m

/// A sheet that lies flat on a plane, tilted by the angle whose tangent is given towards +x.
Scene sheet_on_slope(double tangent, double friction) {
  Scene scene = sheet_on_ground(0, {0, -g, 0}, glm::dvec3(0.0));
  remove_solids<Ground>(scene);
  const glm::dvec3 normal = glm::normalize(glm::dvec3(tangent, 1, 0));
  set_solid(scene, {.shape = SolidPlane{.point = {7, -7 * tangent, 3}, .normal = normal}, .friction = friction});
  return scene;
}

/// It falls on it edge first, slides, and goes on by the closed form, or stops.
TEST(SolidMotion, ASlopeHoldsWhatFrictionHolds) {
  for (const double tangent : {0.3, 0.49, 0.51, 0.9}) {
    Scene scene = sheet_on_slope(tangent, 0.5);
    scene.bodies[0].position = {0, 0.5, 0};
    World world(scene, {});
    run(world, 150);
    const double before = glm::length(motion(world, 0).velocity);
    run(world, 30);
    const double angle = std::atan(tangent), gain = 0.5 * g * (std::sin(angle) - 0.5 * std::cos(angle));
    EXPECT_NEAR(glm::length(motion(world, 0).velocity), std::max(0.0, before + gain), 0.01) << "tangent " << tangent;
    EXPECT_LT(measure(world).deepest_penetration, 1e-5);
    if (tangent == 0.3) {
      EXPECT_LT(before, 1e-3) << "it stands";
    }
  }
}

/// How high a flat sheet jumps that fell from `height` on a box.
double jump(double height, double restitution) {
  Scene scene = sheet_on_ground(0.5, {0, -g, 0}, glm::dvec3(0.0));
  remove_solids<Ground>(scene);
  set_solid(scene, {.shape = SolidBox{.centre = {0, -1, 0}, .half_size = {2, 1, 2}}, .restitution = restitution});
  scene.bodies[0].position.y = height;
  World world(scene, {});
  double highest = 0;
  bool hit = false;
  for (int i = 0; i < 120; ++i) {
    world.step();
    const Motion m = motion(world, 0);
    hit = hit || m.velocity.y > 0 || m.centre.y < 1e-3;
    if (hit) highest = std::max(highest, m.centre.y);
  }
  EXPECT_TRUE(hit);
  return highest;
}

TEST(Restitution, ReturnsItsSquareOfTheHeight) {
  for (const double e : {0.3, 0.5, 0.8, 1.0}) EXPECT_NEAR(jump(1, e), e * e, 0.03) << "restitution " << e;
  EXPECT_LT(jump(1, 0), 1e-3);
}

TEST(Restitution, LetsSlowImpactsRest) {
  const double height = 0.9 * law::impact_speed * law::impact_speed / (2 * g);
  EXPECT_LT(jump(height, 1), 1.001 * height) << "the start";
  Scene scene = sheet_on_ground(0.5, {0, -g, 0}, glm::dvec3(0.0));
  solid_of<Ground>(scene).restitution = 1;
  scene.bodies[0].position.y = height;
  World world(scene, {});
  run(world, 60);
  EXPECT_EQ(measure(world).max_speed, 0);
}

/// A ball of the shipped scenes' kind, thrown down at the ground.
Scene soft_ball(double restitution, double speed) {
  Material m = gas_ball();
  m[contact::rebound_speed] = 2;
  m[Material::internal_damping] = 10;
  Scene scene = lone_body(m, glm::dvec3(0, -speed, 0));
  scene.bodies[0].position = {0, 1, 0};
  set_solid(scene, {Ground{0}, 0.5, restitution});
  return scene;
}

/// How fast it leaves, though its material limits rebound.
double ball_rebound(double restitution, double speed) {
  World world(soft_ball(restitution, speed), {});
  for (int i = 0; i < 240; ++i) world.step();
  return motion(world, 0).velocity.y;
}

TEST(Restitution, OfASoftBallGrowsWithThatOfTheSolid) {
  for (const double impact : {7.8, 8.0, 8.2}) {
    const double soft = ball_rebound(0, impact);
    double before = soft;
    EXPECT_LT(before, 2.1);
    for (const double e : {0.4, 0.6, 0.8, 1.0}) {
      const double speed = ball_rebound(e, impact);
      EXPECT_GT(speed, before) << impact;
      EXPECT_LT(speed, std::hypot(soft, e * impact)) << impact;
      before = speed;
    }
    EXPECT_GT(before, 5) << impact;
  }
}

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

/// In a world where the ball has come upon the ground at 9 m/s before, or in a new one.
TEST(Restitution, OfASoftBallForgetsAnImpactOnceTheBallHasLeft) {
  const auto rebound = [](bool hit_before) {
    const double speed = 4.5;
    World world(soft_ball(0.3, hit_before ? 9 : speed), {.integrator = {"semi-implicit-euler", 40}});
    if (hit_before) {
      run(world, 40);
      EXPECT_GT(motion(world, 0).velocity.y, 2) << "it has left";
      std::vector<Particle> again;
      for (const glm::dvec3& x : world.model(0).start) again.push_back({x + glm::dvec3(0, 1, 0), {0, -speed, 0}});
      world.set_particles(0, again);
    }
    run(world, 40);
    return motion(world, 0).velocity.y;
  };
  EXPECT_NEAR(rebound(true), rebound(false), 1e-4);
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
  void (*add)(Scene&);  // something about the origin that spans x and z, 0.05 m thick
  double below;         // m: where a body that went through would come out
};

const Target targets[]{
    {"plane",
     [](Scene& s) {
       set_solid(s, {SolidPlane{.normal = {0.28, 0.96, 0}}});
     },
     -3},
    {"plate",
     [](Scene& s) {
       set_solid(s, {SolidBox{.half_size = {3, 0.025, 3}}});
     },
     -0.6},
    {"tilted_plate",
     [](Scene& s) {
       const glm::dmat3 axes(glm::dvec3(0.8, 0.6, 0), glm::dvec3(-0.6, 0.8, 0), glm::dvec3(0, 0, 1));
       set_solid(s, {SolidBox{.half_size = {4, 0.025, 4}, .axes = axes}});
     },
     -4},
    {"capsules",
     [](Scene& s) {
       for (int i = -20; i <= 20; ++i)  // a grate that no mesh of 162 vertices fits through
         add_solid(s, {SolidCapsule{.from = {0.1 * i, 0, -3}, .to = {0.1 * i, 0, 3}, .radius = 0.045}});
     },
     -0.6},
    {"sphere",
     [](Scene& s) {
       set_solid(s, {SolidSphere{.centre = {0, -2, 0}, .radius = 2}});
     },
     -3},
    {"pit",  // of four sides, two of which drive particles into one another
     [](Scene& s) {
       for (const glm::dvec3& normal :
            {glm::dvec3(0.8, 0.6, 0), glm::dvec3(-0.8, 0.6, 0), glm::dvec3(0, 0.6, 0.8), glm::dvec3(0, 0.6, -0.8)})
         add_solid(s, {SolidPlane{.point = {0, -1, 0}, .normal = normal}});
     },
     -1},
};

class FastImpact : public testing::TestWithParam<Target> {};

/// Straight down and across, alone, with and without restitution.
TEST_P(FastImpact, GoesNeitherInNorThroughAndDoesNotExplode) {
  for (const glm::dvec3& direction : {glm::dvec3(0, -1, 0), glm::dvec3(0.48, -0.8, 0.36)})
    for (const double restitution : {0.0, 0.5}) {
      Material m = gas_ball();
      m[Material::thickness] = 0.005;
      Scene scene = lone_body(m, thrown * direction);
      scene.gravity = {0, -g, 0};
      scene.bodies[0].position = glm::dvec3(0.03, 0.1, 0.02) - 3.0 * direction;
      GetParam().add(scene);
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

TEST(SolidMotion, TheShippedContainerLosesNone) {
  World world(find_scene("container", SBCOLLIDE_SCENES), {.threads = 2});
  run(world, 200);  // by then all have fallen
  ASSERT_EQ(world.bodies().count(), 47u);
  for (BodyId b = 0; b < 47; ++b) {
    const glm::dvec3 centre = motion(world, b).centre;
    EXPECT_LT(std::max(std::abs(centre.x), std::abs(centre.z)), 2.5 - 0.4)
        << "body " << b << " at " << centre.x << ", " << centre.y << ", " << centre.z;
  }
}

TEST(SolidMotion, ABallComesToRestInABox) {
  Material m = damped(gas_ball());
  m[Material::thickness] = 0.005;
  Scene scene = lone_body(m, glm::dvec3(3, 0, 2));
  scene.gravity = {0, -g, 0};
  scene.sleep.speed = 0.05;
  scene.bodies[0].position = {0, 1.5, 0};
  set_solid(scene, {SolidBox{.centre = {0, -0.1, 0}, .half_size = {1.2, 0.1, 1.2}}});
  for (const double side : {-1.0, 1.0}) {
    add_solid(scene, {SolidBox{.centre = {1.1 * side, 0.5, 0}, .half_size = {0.1, 0.5, 1.2}}});
    add_solid(scene, {SolidBox{.centre = {0, 0.5, 1.1 * side}, .half_size = {1.2, 0.5, 0.1}}});
  }
  World world(scene, {});
  for (int i = 0; i < 400; ++i) {
    world.step();
    ASSERT_LT(measure(world).deepest_penetration, 1e-4) << "frame " << i;
  }
  EXPECT_TRUE(world.all_at_rest());
  const glm::dvec3 centre = motion(world, 0).centre;
  EXPECT_LT(std::max(std::abs(centre.x), std::abs(centre.z)), 0.6) << "inside";
  EXPECT_NEAR(centre.y, 0.5, 0.06);
}

}  // namespace THIS_FILE
}  // namespace softbody::test
