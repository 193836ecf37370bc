#include "softbody/forces/grab.h"
#include "softbody/integrate/force_stage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "tests/softbody/helpers.h"
#include "tests/support/world_test_access.h"

namespace softbody {
namespace THIS_FILE {

/// On the first face of body 0, not at its middle.
Grab on_first_face(const World& world) {
  return {.corners = world.model(0).mesh.triangles[0], .weights = {0.5, 0.3, 0.2}};
}

/// At the middle of the highest face, under which it does not swing.
Grab on_top(const World& world) {
  const Mesh& mesh = world.model(0).mesh;
  const auto height = [&](const Triangle& t) {
    return mesh.vertices[t[0]].y + mesh.vertices[t[1]].y + mesh.vertices[t[2]].y;
  };
  const Triangle& top = *std::ranges::max_element(mesh.triangles, {}, height);
  return {.corners = top, .weights = glm::dvec3(1.0 / 3)};
}

/// Takes body 0 where it is and pulls by `stretch`.
glm::dvec3 take(World& world, Grab grab, const glm::dvec3& stretch) {
  world.grab(grab);
  const glm::dvec3 from = grabbed_point(world);
  grab.target = from + stretch;
  world.grab(grab);
  return from;
}

TEST(Grab, TheForceIsTheSpringsAndDampersForASmallStepAndBoundedForAnyOther) {
  const glm::dvec3 stretch(0.1, 0, 0), v(0, 2, 0);
  const glm::dvec3 force = pull(30, 4, 0.5, 1e-9, stretch, v);
  EXPECT_NEAR(force.x, 3, 1e-6);
  EXPECT_NEAR(force.y, -8, 1e-6);
  const double h = 1e-3, m = 0.5;
  for (const double k : {1e3, 1e9, 1e15}) {
    const glm::dvec3 after = v + h / m * pull(k, 0, m, h, stretch, v);  // the point never overshoots
    EXPECT_LE(after.x * h, stretch.x * (1 + 1e-12));
    EXPECT_GE(after.y, 0);
  }
}

TEST(Grab, AFreePointSwingsAsTheClosedFormSays) {
  Material dust = test::spring_ball();
  dust[StructuralSprings::stiffness] = dust[BendSprings::stiffness] = 0;  // particles that know nothing of each other
  World world(test::lone_body(dust), {.frame_time = 1e-4});
  Grab grab = on_first_face(world);
  grab.frequency = 0.2;
  grab.damping_ratio = 0.05;
  const double stretch = 0.1;
  const glm::dvec3 from = take(world, grab, {stretch, 0, 0});
  const double mass = world.model(0).particle_mass / glm::dot(grab.weights, grab.weights);
  const double rate = 2 * std::numbers::pi * grab.frequency, k = dust[Material::mass] * rate * rate;
  const double decay = grab.damping_ratio * dust[Material::mass] * rate / mass;
  const double swing = std::sqrt(k / mass - decay * decay);
  for (int frame = 1; frame <= 6000; ++frame) {
    world.step();
    const double t = frame * world.frame_time();
    const double left = stretch * std::exp(-decay * t) * (std::cos(swing * t) + decay / swing * std::sin(swing * t));
    const glm::dvec3 moved = grabbed_point(world) - from;
    ASSERT_NEAR(moved.x, stretch - left, 1e-3 * stretch) << frame;
    ASSERT_NEAR(moved.y, 0, 1e-6);
  }
  EXPECT_LT(std::abs(decay), swing);  // it did swing
}

TEST(Grab, AHangingBodySagsByItsWeight) {
  for (const Integrator& integrator : integrators()) {
    for (const double mass : {0.5, 2.0}) {
      Material material = test::spring_ball();
      material[Material::mass] = mass;
      material[Material::internal_damping] = 10;
      Scene scene = test::lone_body(material);
      scene.gravity = {0, -9.81, 0};
      World world(scene, {.integrator = {std::string(integrator.key)}});
      const Grab grab = on_top(world);
      const glm::dvec3 hand = take(world, grab, glm::dvec3(0.0));
      test::run(world, 180);
      const double rate = 2 * std::numbers::pi * grab.frequency;
      const glm::dvec3 sag = hand - grabbed_point(world);
      EXPECT_NEAR(sag.y, 9.81 / (rate * rate), 1e-3) << integrator.key << ", " << mass << " kg";
      EXPECT_LT(glm::length(glm::dvec2(sag.x, sag.z)), 5e-3);  // it may still swing a little
    }
  }
}

TEST(Grab, ABodySagsByItsWeightInLongSubstepsToo) {
  Material material = test::spring_ball();
  material[Material::internal_damping] = 10;
  Scene scene = test::lone_body(material);
  scene.gravity = {0, -9.81, 0};
  World world(scene, {.integrator = {"semi-implicit-euler", 8}});
  const Grab grab = on_top(world);
  const glm::dvec3 hand = take(world, grab, glm::dvec3(0.0));
  test::run(world, 180);
  const double rate = 2 * std::numbers::pi * grab.frequency;
  EXPECT_NEAR(hand.y - grabbed_point(world).y, 9.81 / (rate * rate), 1e-3);
}

TEST(Grab, StaysFiniteAtAnyStiffnessAndMass) {
  for (const double frequency : {1e-3, 1.0, 1e2, 1e6}) {
    for (const double mass : {1e-2, 1e3}) {
      for (const double ratio : {0.0, 100.0}) {
        Material material = test::gas_ball();
        material[Material::mass] = mass;
        World world(test::lone_body(material), {});
        Grab grab = on_first_face(world);
        grab.frequency = frequency;
        grab.damping_ratio = ratio;
        const glm::dvec3 from = take(world, grab, {0.5, 0.5, 0});
        test::run(world, 60);
        const Measures m = measure(world);
        EXPECT_TRUE(m.finite) << frequency << " Hz, " << mass << " kg";
        EXPECT_LT(m.max_speed, 200) << frequency << " Hz, " << mass << " kg";
        if (frequency < 1e3 || ratio > 0) continue;
        EXPECT_LT(glm::distance(grabbed_point(world), from + glm::dvec3(0.5, 0.5, 0)), 0.01);
      }
    }
  }
}

TEST(Grab, IsAStageOnlyWhileAHandHolds) {
  World world(test::lone_body(test::spring_ball()), {});
  EXPECT_FALSE(world.plan().has(stage_of<Hand>));
  const std::uint64_t at_rest = world.state_hash();
  take(world, on_first_face(world), {0, 1, 0});
  EXPECT_TRUE(world.plan().has(stage_of<Hand>));
  test::run(world, 1);
  EXPECT_NE(world.state_hash(), at_rest);
  world.grab({});
  EXPECT_FALSE(world.plan().has(stage_of<Hand>));
  EXPECT_FALSE(world.grabbed());
}

TEST(Grab, WakesASleeperKeepsItAwakeAndFreesAHeldBody) {
  Scene scene = test::lone_body(test::spring_ball());
  scene.sleep = {0.05, 5};
  scene.bodies[0].release = 1000;
  World world(scene, {});
  ASSERT_TRUE(world.body(0).pinned);
  take(world, on_first_face(world), glm::dvec3(0.0));
  EXPECT_FALSE(world.body(0).pinned);
  world.grab({});
  test::run(world, 10);
  ASSERT_TRUE(world.body(0).asleep);
  take(world, on_first_face(world), glm::dvec3(0.0));
  test::run(world, 30);
  EXPECT_FALSE(world.body(0).asleep);
  world.grab({});
  test::run(world, 10);
  EXPECT_TRUE(world.body(0).asleep);
}

}  // namespace THIS_FILE
}  // namespace softbody
