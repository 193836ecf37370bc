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

/// Returns a grab of a point of the first face of body 0 that is not its middle.
Grab on_first_face(const World& world) {
  return {.corners = world.model(0).mesh.triangles[0], .weights = {0.5, 0.3, 0.2}};
}

/// Returns a grab of the middle of the highest face, under which the body does not swing.
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

TEST(Pull, IsThatOfASpringAndADamperInShortStepsAndBoundedInLongOnes) {
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

/// The hand holds the second of two bodies; the other stays where it is.
TEST(Grab, SwingsAFreePointAsTheClosedFormSays) {
  Material dust = test::spring_ball();
  dust[StructuralSprings::stiffness] = dust[BendSprings::stiffness] = 0;  // particles that know nothing of each other
  Scene scene = test::lone_body(dust);
  test::add_body(scene, {5, 0, 0}, glm::dvec3(0.0));
  World world(scene, {.frame_time = 1e-4});
  Grab grab = on_first_face(world);
  grab.body = 1;
  grab.frequency = 0.2;
  grab.damping_ratio = 0.05;
  const double stretch = 0.1;
  const glm::dvec3 from = take(world, grab, {stretch, 0, 0});
  const double mass = world.model(0).particle_mass / glm::dot(grab.weights, grab.weights);
  const double rate = 2 * std::numbers::pi * grab.frequency, k = dust[Material::mass] * rate * rate;
  const double decay = grab.damping_ratio * dust[Material::mass] * rate / mass;
  const double swing = std::sqrt(k / mass - decay * decay);
  ASSERT_LT(std::abs(decay), swing);
  for (int frame = 1; frame <= 6000; ++frame) {
    world.step();
    const double t = frame * world.frame_time();
    const double left = stretch * std::exp(-decay * t) * (std::cos(swing * t) + decay / swing * std::sin(swing * t));
    const glm::dvec3 moved = grabbed_point(world) - from;
    ASSERT_NEAR(moved.x, stretch - left, 1e-3 * stretch) << frame;
    ASSERT_NEAR(moved.y, 0, 1e-6);
  }
  EXPECT_EQ(world.state().max_particle_speed(0), 0);
}

TEST(Grab, LetsAHangingBodySagByItsWeight) {
  const auto sag = [](double mass, const IntegratorChoice& choice) {
    Material material = test::spring_ball();
    material[Material::mass] = mass;
    material[Material::internal_damping] = 10;
    Scene scene = test::lone_body(material);
    scene.gravity = {0, -9.81, 0};
    World world(scene, {.integrator = choice});
    const glm::dvec3 hand = take(world, on_top(world), glm::dvec3(0.0));
    test::run(world, 180);
    return hand - grabbed_point(world);
  };
  const double rate = 2 * std::numbers::pi * Grab().frequency, expected = 9.81 / (rate * rate);
  for (const Integrator& integrator : integrators())
    for (const double mass : {0.5, 2.0}) {
      const glm::dvec3 found = sag(mass, {std::string(integrator.key)});
      EXPECT_NEAR(found.y, expected, 1e-3) << integrator.key << ", " << mass << " kg";
      EXPECT_LT(glm::length(glm::dvec2(found.x, found.z)), 5e-3);  // it may still swing a little
    }
  EXPECT_NEAR(sag(1, {"semi-implicit-euler", 8}).y, expected, 1e-3) << "in long substeps, too";
}

TEST(Grab, StaysFiniteAtAnyStiffnessAndMass) {
  for (const double frequency : {1e2, 1e6}) {
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
