// A world that is put back goes on to the bit, in the same world and in a new one.

#include "softbody/world/snapshot.h"

#include <gtest/gtest.h>

#include "tests/softbody/helpers.h"
#include "tests/support/change.h"
#include "tests/support/world_test_access.h"

namespace softbody::test {
namespace THIS_FILE {

/// What a few frames led to.
struct Course {
  std::vector<std::uint64_t> hashes;
  std::vector<std::vector<collide::Contact>> contacts;
  bool operator==(const Course&) const = default;
};

Course follow(World& world, int frames) {
  Course course{{world.state_hash()}, {world.detection().contacts}};
  for (int i = 0; i < frames; ++i) {
    world.step();
    course.hashes.push_back(world.state_hash());
    course.contacts.push_back(world.detection().contacts);
  }
  return course;
}

/// Goes on from here for some frames, and again from a snapshot, here and in a world of `scene` that has just begun.
void expect_the_same_again(World& world, const Scene& scene, int frames) {
  const Snapshot snapshot = world.snapshot();
  const auto touches = [](const World& w) { return w.surface_contacts().size(); };
  const std::size_t touched = touches(world);
  const double held = WorldTestAccess::penalty_energy(world);
  const Course first = follow(world, frames);
  world.restore(snapshot);
  EXPECT_EQ(world.frame(), snapshot.frame);
  EXPECT_EQ(touches(world), touched);
  EXPECT_TRUE(follow(world, frames) == first) << "from frame " << snapshot.frame;
  World fresh(scene, {.threads = 2});
  fresh.restore(snapshot);
  EXPECT_EQ(WorldTestAccess::penalty_energy(fresh), held);
  EXPECT_TRUE(follow(fresh, frames) == first) << "in a new world from frame " << snapshot.frame;
}

TEST(Snapshot, ContinuesToTheBitByEitherContact) {
  for (const ContactSurfaceInfo& surface : contact_surfaces) {
    SCOPED_TRACE(surface.key);
    Scene scene = find_scene("star", SBCOLLIDE_SCENES);
    scene.contact_surface = surface.value;
    World world(scene, {.threads = 2});
    run(world, 60);  // the upper stars have fallen on the lower ones
    expect_the_same_again(world, scene, 4);
  }
}

/// Everything that a scene can be asked for while it runs: hands, drops, other settings, arrivals still to come.
TEST(Snapshot, HoldsWhatWasAskedForSinceTheStart) {
  const Scene scene = drop_scene();
  World world(scene, {.threads = 2});
  run(world, 10);
  world.drop(3);
  world.throw_body({-3, 4, 0}, {5, 0, 0});
  world.remove(1);
  change(world, [](Scene& s) {
    s.materials[0][StructuralSprings::stiffness] = 100;
    s.gravity = {0, -5, 0};
    s.method = collide::paper_method;
    s.collision.tolerance *= 1.5f;
    s.collision.buckets = 17;
  });
  world.set_integrator({"velocity-verlet", 40});
  world.grab(Grab{.body = 0, .target = {1, 4, 0}});
  run(world, 50);
  const Snapshot snapshot = world.snapshot();
  const double time = world.last_step().time;
  EXPECT_GE(snapshot.bytes(), world.bodies().vertex_count() * 6 * sizeof(float));
  expect_the_same_again(world, scene, 10);
  world.restore(snapshot);
  EXPECT_TRUE(world.grabbed());
  world.drop();
  const Course first = follow(world, 40);
  World fresh(find_scene("cloth", SBCOLLIDE_SCENES), {});  // one of another scene brings that scene with it
  fresh.restore(snapshot);
  EXPECT_TRUE(fresh.scene() == world.scene());
  EXPECT_EQ(fresh.integrator_choice(), (IntegratorChoice{"velocity-verlet", 40}));
  EXPECT_EQ(fresh.last_step().time, time);
  EXPECT_EQ(fresh.collision(), world.collision());
  fresh.drop();
  EXPECT_TRUE(follow(fresh, 40) == first);
}

TEST(Snapshot, GoesBackOverArrivalsAndIntoSleep) {
  Scene scene = drop_scene();
  World world(scene, {.threads = 2});
  const Snapshot start = world.snapshot();
  while (!world.all_at_rest() && world.frame() < 2000) world.step();
  ASSERT_TRUE(world.all_at_rest());
  const std::uint64_t rest = world.state_hash();
  const int frames = world.frame();
  const Snapshot asleep = world.snapshot();
  world.restore(start);
  EXPECT_FALSE(world.all_at_rest());
  run(world, frames);
  EXPECT_EQ(world.state_hash(), rest);
  World fresh(scene, {});
  fresh.restore(asleep);
  EXPECT_TRUE(fresh.all_at_rest());
  EXPECT_EQ(follow(fresh, 3), follow(world, 3));
}

/// A material that implicit steps carry and the snapshot's integrator cannot, except in slow motion.
TEST(Snapshot, OfAStiffWorldIsPutBack) {
  Scene scene = lone_body(spring_ball());
  scene.materials[0].set(StructuralSprings::keys, {1e9, 0.1});
  add_body(scene, {0, 1.05, 0}, glm::dvec3(0.0));
  World world(scene, {.budget = {.least = 1e6}});
  run(world, 3);
  world.set_integrator({"semi-implicit-euler"});
  run(world, 2);
  EXPECT_LT(world.last_step().seconds, world.frame_time());
  const Snapshot snapshot = world.snapshot();
  world.set_integrator({"auto"});
  world.step();
  EXPECT_EQ(world.last_step().seconds, world.frame_time());
  world.restore(snapshot);
  const Course first = follow(world, 2);
  world.restore(snapshot);
  EXPECT_TRUE(follow(world, 2) == first);
}

/// One more body fills the last lane of a block, so nothing else is larger.
TEST(Snapshot, ABodyTakesItsOwnSizeBesideItsParticles) {
  const auto bytes = [](int bodies) {
    Scene scene = lone_body(spring_ball());
    for (int i = 1; i < bodies; ++i) add_body(scene, {2.0 * i, 0, 0}, glm::dvec3(0.0));
    const World world(scene, {});
    return WorldTestAccess::solver(world).save().bytes();
  };
  EXPECT_EQ(bytes(lanes) - bytes(lanes - 1), sizeof(Body));
}

}  // namespace THIS_FILE
}  // namespace softbody::test
