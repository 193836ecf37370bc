// Surface contact gives equal results however it is run, may be turned on and off, and leaves vertex contact alone.

#include <gtest/gtest.h>

#include "softbody/integrate/force_stage.h"
#include "tests/every_target.h"
#include "tests/softbody/surface_rig.h"
#include "tests/support/change.h"
#include "tests/support/world_test_access.h"

namespace softbody::test {
namespace THIS_FILE {

/// Four balls that meet in mid-air.
Scene crowd() {
  Scene scene = ball_in_space(rubber(), {4, 0, 0});
  scene.gravity = {0, -9.81, 0};
  set_solid(scene, {Ground{-0.8}, 0.5});
  add_body(scene, {1.2, 0.3, 0}, {-4, 0, 0});
  add_body(scene, {0.5, 1.2, 0.2}, {0, -4, 0});
  add_body(scene, {0.6, 2.3, 0.1}, {0, -8, 0});
  return scene;
}

/// Balls of several sizes that meet, each with a body model of its own: there is something for each thread.
Scene sizes() {
  Scene scene = crowd();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) scene.bodies[i].mesh.radius -= 0.02 * double(i);
  return scene;
}

/// Sheets that fall flat on each other: so many rows that threads share the solver too.
Scene sheets() {
  Scene scene = ball_in_space(rubber());
  scene.collision.self_collision = false;
  scene.gravity = {0, -9.81, 0};
  set_solid(scene, {Ground{}});
  scene.bodies.clear();
  for (int i = 0; i < 5; ++i) {
    add_body(scene, {0.03 * i, 0.01 + 0.008 * i, 0.02 * i}, glm::dvec3(0.0));
    scene.bodies.back().mesh = {.kind = "grid", .columns = 16, .rows = 16, .width = 2 - 0.1 * i, .depth = 2};
  }
  return scene;
}

TEST(SurfaceContact, IsTheSameOnAnyThreadsAndInstructionSet) {
  std::size_t max_rows = 0;
  const auto hash = [&](const Scene& scene, int frames, int threads, std::int64_t target) {
    const tests::UseTarget use(target);
    World::Options options;
    options.threads = threads;
    options.least_share = 0;
    World world(scene, options);
    for (int i = 0; i < frames; ++i) {
      world.step();
      max_rows = std::max(max_rows, WorldTestAccess::solver(world).surface_contact().rows());
    }
    return world.state_hash();
  };
  for (const auto& [scene, frames] : {std::pair(sizes(), 25), std::pair(sheets(), 10)}) {
    const std::uint64_t expected = hash(scene, frames, 1, tests::targets().front());
    for (const std::int64_t target : tests::targets())
      for (const int threads : {1, 2}) EXPECT_EQ(hash(scene, frames, threads, target), expected) << threads;
  }
  EXPECT_GT(max_rows, 2000u);
}

TEST(SurfaceContact, MayBeTurnedOnAndOffAtAnyTime) {
  World world(crowd(), {});
  Judge judge(world);
  for (int i = 0; i < 60; ++i) {
    if (i % 7 == 3) change(world, [&](Scene& s) { s.contact_surface = ContactSurface::vertices; });
    if (i % 7 == 5) change(world, [&](Scene& s) { s.contact_surface = ContactSurface::surfaces; });
    world.step();
    ASSERT_TRUE(measure(world).finite) << frame_of(world);
    ASSERT_LT(measure(world).max_speed, 40) << frame_of(world);
  }
  change(world, [&](Scene& s) { s.contact_surface = ContactSurface::surfaces; });
  EXPECT_TRUE(world.plan().has(Stage::surface_contact));
  EXPECT_FALSE(world.plan().has(stage_of<PenaltyContact>));
  run(world, 60);
  judge.expect_clean("after a second of surface contact");
}

TEST(SurfaceContact, LeavesVertexContactAsItIs) {
  const auto hash = [](bool to_and_fro) {
    Scene scene = crowd();
    scene.contact_surface = ContactSurface::vertices;
    World world(scene, {});
    if (to_and_fro) {
      change(world, [&](Scene& s) { s.contact_surface = ContactSurface::surfaces; });
      change(world, [&](Scene& s) { s.contact_surface = ContactSurface::vertices; });
    }
    run(world, 30);
    return world.state_hash();
  };
  EXPECT_EQ(hash(true), hash(false));
}

}  // namespace THIS_FILE
}  // namespace softbody::test
