// Bodies at rest sleep by islands, and wake when hit.

#include "softbody/world/sleep.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "softbody/mechanics/make_body_model.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

/// Three bodies with speeds of their own; who touches whom is made up, so only the rule itself is tried.
class SleepRules : public testing::Test {
 protected:
  SleepRules() {
    const auto model = make_body_model({}, spring_ball());
    for (const double speed : {0.0, 0.5, 0.02})
      state.memory(state.add(model, glm::dvec3(0.0), glm::dvec3(speed, 0, 0))).speed = speed;
    for (BodyId b = 0; b < 3; ++b) vertex_body.insert(vertex_body.end(), 162, b);
  }
  void settle(int frames, const std::vector<collide::Contact>& contacts) {
    for (int i = 0; i < frames; ++i) softbody::settle(rule, state, vertex_body, contacts, {});
  }
  bool asleep(BodyId b) const { return state.body(b).asleep; }
  static collide::Contact touch(BodyId a, BodyId b) { return {a * 162 + 5, b * 162 + 7}; }

  State state;
  SleepRule rule{.speed = 0.1, .frames = 10};
  std::vector<BodyId> vertex_body;
};

TEST_F(SleepRules, CalmBodiesSleepAfterTheFramesOfTheRule) {
  settle(9, {});
  EXPECT_FALSE(asleep(0) || asleep(1) || asleep(2));
  settle(1, {});
  EXPECT_TRUE(asleep(0));
  EXPECT_FALSE(asleep(1)) << "too fast";
  EXPECT_TRUE(asleep(2));
  EXPECT_EQ(state.max_particle_speed(2), 0) << "a sleeper stands still";
}

TEST_F(SleepRules, AnIslandSleepsTogetherOrNotAtAll) {
  settle(100, {touch(0, 2), touch(1, 2)});
  EXPECT_FALSE(asleep(0)) << "it touches 2, which touches 1, which moves";
  EXPECT_FALSE(asleep(2));
  settle(1, {touch(0, 2)});
  EXPECT_TRUE(asleep(0) && asleep(2)) << "calm for long enough, and now away from 1";
  EXPECT_FALSE(asleep(1));
}

TEST_F(SleepRules, AnIslandWaitsForItsLastBody) {
  settle(5, {});
  state.memory(2).calm_frames = 0;
  settle(5, {touch(0, 2)});
  EXPECT_FALSE(asleep(0) || asleep(2));
  settle(5, {touch(0, 2)});
  EXPECT_TRUE(asleep(0) && asleep(2));
}

TEST_F(SleepRules, ContactsInsideOneBodyBindNothing) {
  settle(10, {{3, 50}});
  EXPECT_TRUE(asleep(0));
}

TEST_F(SleepRules, AFastBodyWakesTheSleepersItTouchesAndASlowOneDoesNot) {
  settle(10, {});
  ASSERT_TRUE(asleep(0) && asleep(2));
  wake_touched(rule, state, vertex_body, {touch(0, 2)});
  EXPECT_TRUE(asleep(0) && asleep(2)) << "sleepers do not wake each other";
  wake_touched(rule, state, vertex_body, {touch(0, 1)});
  EXPECT_FALSE(asleep(0));
  EXPECT_TRUE(asleep(2));
  wake_touched(rule, state, vertex_body, {touch(0, 2)});
  EXPECT_TRUE(asleep(2)) << "0 is awake but stands";
  rule.speed = 0.3;
  wake_touched(rule, state, vertex_body, {touch(1, 2)});
  EXPECT_TRUE(asleep(2)) << "0.5 m/s is less than twice the rule's speed";
  rule.speed = 0.2;
  wake_touched(rule, state, vertex_body, {touch(1, 2)});
  EXPECT_FALSE(asleep(2));
}

/// A body that lies on the ground, and one that falls on it later.
TEST(Sleep, EndsWhenABodyIsHitAndComesBackInTheEnd) {
  Material m = gas_ball();
  m[Material::internal_damping] = 20;
  m[contact::rebound_speed] = 1;
  m[contact::rolling_resistance] = 0.3;
  Scene scene = lone_body(m);
  scene.gravity = {0, -9.81, 0};
  scene.sleep = {.speed = 0.05, .frames = 20};
  set_solid(scene, {Ground{}});
  scene.bodies[0].position = {0, 0.55, 0};
  add_body(scene, {0.3, 2.5, 0}, glm::dvec3(0.0));
  scene.bodies[1].appear = scene.bodies[1].release = 200;
  World world(scene, {});
  run(world, 200);
  ASSERT_TRUE(world.body(0).asleep);
  EXPECT_FALSE(world.all_at_rest()) << "one is still to come";
  const glm::dvec3 lying = motion(world, 0).centre;
  run(world, 20);
  EXPECT_EQ(motion(world, 0).centre, lying) << "not touched yet";
  bool woke = false;
  for (int i = 0; i < 60; ++i) {
    world.step();
    woke = woke || !world.body(0).asleep;
  }
  EXPECT_TRUE(woke);
  EXPECT_GT(glm::distance(motion(world, 0).centre, lying), 5e-4) << "it was pushed";
  run(world, 600);
  EXPECT_TRUE(world.all_at_rest());
  const std::uint64_t hash = world.state_hash();
  run(world, 10);
  EXPECT_EQ(world.state_hash(), hash);
  EXPECT_EQ(world.last_step().substeps, 0) << "sleepers cost nothing";
}

/// A ball slides over a mat without friction; no vertex of the one is near any of the other.
TEST(Sleep, SparesABodyThatCarriesOneThatMoves) {
  Material smooth = spring_ball();
  smooth[contact::friction] = smooth[contact::rolling_resistance] = 0;
  smooth[Material::internal_damping] = 10;
  Scene scene = lone_body(smooth, {1, 0, 0});
  scene.gravity = {0, -9.81, 0};
  set_solid(scene, {Ground{0}, 0.6, 0});
  scene.contact_surface = ContactSurface::surfaces;
  scene.collision.tolerance = 1e-4f;
  scene.sleep = {.speed = 0.1, .frames = 10};
  Material heavy = smooth;
  heavy[Material::mass] = 50;
  scene.materials.push_back(heavy);
  scene.materials[0][Material::mass] = 0.2;
  scene.bodies.push_back(scene.bodies[0]);
  scene.bodies[1].material = 1;
  scene.bodies[0].position = {-0.6, 0.52, 0.01};
  scene.bodies[1].mesh = {.kind = "grid", .columns = 5, .rows = 5, .width = 3, .depth = 3};
  scene.bodies[1].velocity = glm::dvec3(0.0);
  scene.bodies[1].position = {0, 0.006, 0};
  World world(scene, {});
  for (int i = 0; i < 60; ++i) {
    world.step();
    ASSERT_TRUE(world.detection().contacts.empty());
    ASSERT_GT(world.state().max_particle_speed(0), 0.2) << "it slides";
    EXPECT_FALSE(world.body(1).asleep) << world.frame();
  }
  EXPECT_LT(world.state().max_particle_speed(1), 0.1) << "calm enough to sleep";
}

TEST(Sleep, EndsOnEverySideOfABodyThatIsRemoved) {
  Scene scene = lone_body(spring_ball());
  scene.contact_surface = ContactSurface::surfaces;
  scene.collision.tolerance = 1e-3f;
  scene.sleep = {1, 2};
  std::vector<bool> near;
  for (int axis = 0; axis < 3; ++axis)
    for (const double distance : {-1.03, 1.03, -3.0, 3.0}) {
      glm::dvec3 place(0.0);
      place[axis] = distance;
      add_body(scene, place, glm::dvec3(0.0));
      near.push_back(std::abs(distance) < 2);
    }
  World world(scene, {});
  run(world, 4);
  ASSERT_TRUE(world.all_at_rest());
  world.remove(0);
  for (BodyId b = 0; b < near.size(); ++b) EXPECT_EQ(world.body(b).asleep, !near[b]) << b;
}

}  // namespace THIS_FILE
}  // namespace softbody::test
