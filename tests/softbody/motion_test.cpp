// Bodies in free flight: closed forms, order of convergence, what is conserved, far from the origin.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

TEST(FreeFall, IsTheClosedFormOfSemiImplicitEuler) {
  Scene scene = lone_body(spring_ball(), glm::dvec3(1.5, 4, -0.5));
  scene.gravity = {0.3, -9.81, 0};
  World world(scene, {});
  for (int frame = 1; frame <= 180; ++frame) {
    world.step();
    const double n = frame * world.last_step().substeps, t = frame / 60.0, h = t / n;
    const Motion m = motion(world, 0);
    ASSERT_GT(world.last_step().substeps, 1);
    const glm::dvec3 v = scene.bodies[0].velocity + t * scene.gravity;
    const glm::dvec3 x = t * scene.bodies[0].velocity + h * h * n * (n + 1) / 2 * scene.gravity;
    ASSERT_LT(glm::distance(m.velocity, v), 2e-5 * (1 + glm::length(v))) << "frame " << frame;
    ASSERT_LT(glm::distance(m.centre, x), 2e-5 * (1 + glm::length(x))) << "frame " << frame;
  }
}

TEST(BodyOrigin, FollowsItsParticlesWithoutAJump) {
  Scene scene = lone_body(spring_ball(), glm::dvec3(90, 0, 0));
  World world(scene, {});
  int moves = 0;
  glm::dvec3 origin = world.body(0).origin;
  for (int frame = 1; frame <= 300; ++frame) {
    world.step();
    EXPECT_NEAR(motion(world, 0).centre.x, frame * 1.5, 1e-6 * (1 + frame * 1.5));
    EXPECT_LT(glm::distance(world.body(0).origin, motion(world, 0).centre), 0.5 * 6 + 1.5);
    moves += world.body(0).origin != origin;
    origin = world.body(0).origin;
    EXPECT_EQ(origin, glm::round(origin * 64.0) / 64.0) << "floats hold the shift without loss";
  }
  EXPECT_GT(moves, 100);
}

TEST(Energy, StaysTheSameWhileABodyFalls) {
  Scene scene = lone_body(gas_ball());
  scene.gravity = {0, -9.81, 0};
  World world(scene, {});
  const double start = measure(world).energy;
  run(world, 60);
  const double fallen = 0.5 * 9.81;
  EXPECT_NEAR(measure(world).energy, start, 0.01 * fallen * 9.81);
  EXPECT_NEAR(measure(world).momentum.y, -9.81, 1e-3) << "1 kg after a second";
}

TEST(Energy, CountsTheStretchOfTheDiagonals) {
  constexpr int columns = 3, rows = 2;
  constexpr double width = 0.2, depth = 0.3, shift = 0.4,
                   k = 70;  // of a quad, m; of a row against the next, per m; N/m
  Material m = spring_ball();
  m[StructuralSprings::stiffness] = m[BendSprings::stiffness] = 0;
  m.set(ShearSprings::keys, {k, 0});
  Scene scene = lone_body(m);
  scene.bodies[0].mesh = {
      .kind = "grid", .columns = columns, .rows = rows, .width = columns * width, .depth = rows * depth};
  World world(scene, {});
  EXPECT_NEAR(measure(world).energies.elastic, 0, 1e-9);
  std::vector<Particle> sheared = particles_of(world);
  for (Particle& p : sheared) p.position.x += shift * p.position.z;
  world.set_particles(0, sheared);
  const auto energy = [](double across) {
    const double stretch = std::hypot(across, depth) - std::hypot(width, depth);
    return 0.5 * k * stretch * stretch;
  };
  const double expected = columns * rows * (energy(width + shift * depth) + energy(width - shift * depth));
  EXPECT_NEAR(measure(world).energies.elastic, expected, 1e-5 * expected);
  EXPECT_NEAR(measure(world).largest_strain, std::hypot(width + shift * depth, depth) / std::hypot(width, depth) - 1,
              1e-5);
}

TEST(Measures, AreTheExtremesOfAllBodies) {
  Scene scene = lone_body(spring_ball());
  add_body(scene, {5, 0, 0}, glm::dvec3(0.0));
  World world(scene, {});
  for (const double scale : {0.5, 1.25}) {  // compressed and stretched, the first body alone
    place(world, glm::dvec3(scale), 3);
    const Measures all = measure(world);
    EXPECT_NEAR(all.largest_strain, std::abs(scale - 1), 1e-5);
    EXPECT_NEAR(all.max_speed, 3 * 0.5, 1e-5);
    EXPECT_NEAR(all.volume_ratio_min, std::min(1.0, scale * scale * scale), 1e-5);
    EXPECT_NEAR(all.volume_ratio_max, std::max(1.0, scale * scale * scale), 1e-5);
    EXPECT_NEAR(measure(world, 1).largest_strain, 0, 1e-5);
  }
}

/// 1 km away, by powers of two, so that no difference of positions is rounded.
TEST(FarFromTheOrigin, ABodyMovesAsItDoesNearIt) {
  const auto scene_at = [](const glm::dvec3& at) {
    Scene scene = lone_body(gas_ball(), glm::dvec3(0.25, 0, 0));
    scene.gravity = {0, -9.81, 0};
    scene.bodies[0].position = at + glm::dvec3(0.125, 2.75, 0.0625);
    set_solid(scene, {SolidSphere{.centre = at + glm::dvec3(0, 1, 0)}});
    set_solid(scene, {Ground{at.y}, 0.6});
    return scene;
  };
  const glm::dvec3 away(1024, 2048, -1024);
  World near(scene_at(glm::dvec3(0.0)), {}), far(scene_at(away), {});
  for (int frame = 0; frame < 180; ++frame) {
    near.step();
    far.step();
    double apart = 0;
    for (Index i = 0; i < 162; ++i)
      apart = std::max(apart, glm::distance(near.particle(0, i).position + away, far.particle(0, i).position));
    ASSERT_LT(apart, 1e-6) << "frame " << frame;
  }
  EXPECT_GT(glm::length(motion(near, 0).spin_momentum), 0.01) << "it rolled off the solid sphere";
}

TEST(FarFromTheOrigin, BodiesCollideAsTheyDoNearIt) {
  const auto scene_at = [](const glm::dvec3& at) {
    Scene scene = lone_body(gas_ball(), glm::dvec3(2, 0, 0));
    scene.bodies[0].position = at;
    add_body(scene, at + glm::dvec3(1.5, 0.25, 0), glm::dvec3(-1, 0, 0));
    return scene;
  };
  const glm::dvec3 away(1024, 2048, -1024);
  World near(scene_at(glm::dvec3(0.0)), {}), far(scene_at(away), {});
  run(near, 60);
  run(far, 60);
  ASSERT_LT(motion(near, 0).velocity.x, 1.0) << "they hit";
  for (const BodyId b : {0u, 1u}) {  // detectors see world floats, 0.2 mm apart out there
    EXPECT_LT(glm::distance(motion(near, b).centre + away, motion(far, b).centre), 0.02);
    EXPECT_LT(glm::distance(motion(near, b).velocity, motion(far, b).velocity), 0.05);
  }
}

}  // namespace THIS_FILE
}  // namespace softbody::test
