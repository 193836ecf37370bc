// What a frame may be at most: its work, and what is found at once; the rest of it is left out.

#include <gtest/gtest.h>

#include <numbers>

#include "softbody/world/energy_watch.h"
#include "softbody/world/snapshot.h"
#include "tests/softbody/helpers.h"
#include "tests/support/change.h"
#include "tests/support/world_test_access.h"

namespace softbody::test {
namespace THIS_FILE {

TEST(WorkBudget, CutsAFrameShort) {
  constexpr WorkBudget budget{.least = 4e6};
  World world(lone_body(gas_ball()), {.integrator = {"semi-implicit-euler"}, .budget = budget});
  world.step();
  EXPECT_EQ(world.last_step().seconds, world.frame_time());
  place(world, glm::dvec3(1.0), 1e6);
  int substeps = 0;
  for (int frame = 0; frame < 2; ++frame) {
    world.step();
    substeps = world.last_step().substeps;
    EXPECT_NEAR(WorldTestAccess::solver(world).steps().spent(), budget.of(162), 2e4);
    EXPECT_GT(world.last_step().seconds, 0);
    EXPECT_LT(world.last_step().seconds, world.frame_time());
    EXPECT_TRUE(measure(world).finite);
  }
  World fixed(lone_body(gas_ball()), {.integrator = {"semi-implicit-euler", substeps + 1}});
  fixed.step();
  EXPECT_EQ(fixed.last_step().seconds, fixed.frame_time()) << "who fixes substeps gets them";
}

/// A body of a microgram that others hit, or that the air crushes.
TEST(WorkBudget, LeavesTheLightestBodiesFiniteByEveryIntegrator) {
  struct Case {
    double other_mass, contact, springs, frame_time;  // kg, N/m, N/m, s
    float tolerance;                                  // m
    double air;                                       // Pa
  };
  constexpr double frame = 1.0 / 60;
  for (const Integrator& i : integrators())
    for (const Case& c : {Case{1e6, 1e9, 300, frame, 10, 0}, Case{1, 1e5, 1e9, frame, 10, 0},
                          Case{1, 1e9, 1e9, 1, 0.1f, 0}, Case{1, 0, 1e6, frame, 1e-9f, 1e5}}) {
      Material light = spring_ball();
      light[Material::mass] = 1e-9;
      light[Material::start_in_equilibrium] = true;
      light.set(StructuralSprings::keys, {c.springs, 1});
      light[BendSprings::stiffness] = 0;
      light.set(GasPressure::keys, {0.01 * c.air, c.air});
      light[contact::stiffness] = c.contact;
      light[contact::friction] = 10;
      Scene scene = lone_body(light, {0, 1000, 0});
      scene.materials.push_back(light);
      scene.materials[1][Material::mass] = c.other_mass;
      scene.bodies[0].mesh.subdivisions = 0;
      add_body(scene, {0.1, 0.8, 0}, {0, -1000, 0});
      scene.bodies[1].material = 1;
      scene.collision.tolerance = c.tolerance;
      scene.collision.self_collision = true;
      World world(scene, {.frame_time = c.frame_time,
                          .integrator = {std::string(i.key)},
                          .budget = {.least = 3e4, .per_particle = 0}});
      for (int k = 0; k < 12; ++k) {
        world.step();
        ASSERT_TRUE(measure(world).finite) << i.key << ", a mass of " << c.other_mass << ", air of " << c.air;
      }
    }
}

/// 1,000 Hz for a single particle: too fast for XPBD's steps of 1/1200 s, in which such forces act explicitly.
TEST(StepBounds, HoldForTheForcesThatXpbdDoesNotProject) {
  Material m = spring_ball();
  m[ShapeMatching::frequency] = 1e3;
  World world(lone_body(m), {.integrator = {"xpbd"}});
  place(world, glm::dvec3(1.1, 1, 1));
  const double start = measure(world).energy;
  run(world, 10);
  EXPECT_GE(world.last_step().substeps, 1e3 * std::numbers::pi / 60);
  EXPECT_LT(measure(world).energy, 1.1 * start);
}

TEST(WorkBudget, CountsImplicitSteps) {
  Scene scene = lone_body(spring_ball());
  set_solid(scene, {Ground{}});
  const auto step = [&](double work, std::optional<int> substeps) {
    World world(scene, {.integrator = {"implicit", substeps}, .budget = {.least = work, .per_particle = 0}});
    place(world, glm::dvec3(1.0), 2000);
    world.step();
    return world.last_step();
  };
  const StepReport whole = step(1e10, {}), part = step(1e5, {});
  ASSERT_GT(whole.substeps, 10);
  EXPECT_EQ(whole.seconds, 1.0 / 60);
  EXPECT_LT(part.substeps, whole.substeps);
  EXPECT_LT(part.seconds, whole.seconds);
  EXPECT_EQ(step(1, {}).substeps, 1);
  EXPECT_EQ(step(1e5, whole.substeps).seconds, whole.seconds) << "who fixes them gets them";
}

/// One body lies in another of its kind, or beside it.
TEST(WorkBudget, CountsPenaltyPairs) {
  const auto work_of_substep = [](double apart) {
    Scene scene = lone_body(gas_ball(), {0, 5, 0});
    add_body(scene, {apart, 0, 0}, {});
    scene.gravity = {};
    World world(scene, {.integrator = {"semi-implicit-euler"}, .budget = {.least = 0, .per_particle = 0}});
    world.step();
    EXPECT_TRUE(measure(world).finite);
    EXPECT_EQ(world.last_step().substeps, 1);
    const double pairs = double(WorldTestAccess::solver(world).penalty_contact().pairs().size());
    EXPECT_EQ(pairs > 10, apart < 1);
    return WorldTestAccess::solver(world).steps().spent() - pairs * work::penalty_pair;
  };
  EXPECT_DOUBLE_EQ(work_of_substep(0.3), work_of_substep(5));
}

/// Returns two bodies side by side whose surfaces touch.
Scene touching_surfaces() {
  Scene scene = lone_body(gas_ball());
  add_body(scene, {0.99, 0, 0}, {});
  scene.contact_surface = ContactSurface::surfaces;
  return scene;
}

/// Surfaces that pass each other fast have their candidates found anew many times in a frame, which shows in what it
/// took; where that is exactly what it took before, it is missed here.
TEST(WorkBudget, CountsSearchesForSurfaceContact) {
  Scene scene = lone_body(gas_ball(), {50, 0, 0});
  add_body(scene, {1.5, 0, 0}, {-50, 0, 0});
  scene.contact_surface = ContactSurface::surfaces;
  struct Work {
    double found = 0, looked_at = 0, spent = 0, seconds = 0;
  };
  const auto frame = [&](double budget) {
    World world(scene, {.integrator = {"semi-implicit-euler"}, .budget = {.least = budget, .per_particle = 0}});
    const Solver& solver = WorldTestAccess::solver(world);
    const SurfaceContact& contact = solver.surface_contact();
    Work result;
    std::size_t last = 0;
    world.step([&] {
      const std::size_t now = contact.candidates().search().work();
      if (now != last) result.found += work::surface * double(now);
      last = now;
      result.looked_at += solver.steps().work_of_substep() + work::surface * contact.work_of_substep();
    });
    result.spent = solver.steps().spent();
    result.seconds = world.last_step().seconds;
    return result;
  };
  const Work whole = frame(1e10);
  EXPECT_NEAR(whole.spent, whole.found + whole.looked_at, 0.1 * whole.spent);
  ASSERT_GT(whole.found, 0.1 * whole.spent);
  for (const double part : {0.25, 0.5, 0.75}) {
    const Work bound = frame(part * whole.spent);
    EXPECT_NEAR(bound.spent / whole.spent, part, 0.05);
    EXPECT_LT(bound.seconds, whole.seconds);
  }
}

/// Surfaces pass each other by no more than 0.15 edges in a substep.
TEST(StepBounds, AskForSubstepsWhereBodiesPassEachOther) {
  constexpr double speed = 100;  // m/s, towards each other
  Scene scene = lone_body(gas_ball(), {speed / 2, 0, 0});
  add_body(scene, {2, 0, 0}, {-speed / 2, 0, 0});
  scene.contact_surface = ContactSurface::surfaces;
  World world(scene, {.integrator = {"semi-implicit-euler"}});
  world.step();
  EXPECT_GE(world.last_step().substeps, speed * world.frame_time() / (0.15 * world.model(0).mean_edge));
  EXPECT_GE(world.last_step().needed, speed * world.frame_time() / (0.15 * world.model(0).mean_edge));
  scene.contact_surface = ContactSurface::vertices;
  World without(scene, {.integrator = {"semi-implicit-euler"}});
  without.step();
  EXPECT_LT(without.last_step().substeps, world.last_step().substeps / 2);
}

/// Candidates that were found before belong to another moment: nothing may look at them.
TEST(MaxCandidates, EndTheFrame) {
  const auto candidates = [](const World& world) {
    return WorldTestAccess::solver(world).surface_contact().candidates().search().features().size();
  };
  World touching(touching_surfaces(), {});
  touching.step();
  World world(touching_surfaces(), {.max_candidates = {.least = candidates(touching) * 3 / 2, .per_particle = 0}});
  world.step();
  EXPECT_EQ(candidates(world), candidates(touching));
  std::vector<Particle> near = particles_of(world, 1);
  for (Particle& p : near) p.position.x -= 0.3;
  world.set_particles(1, near);
  EXPECT_THROW(world.step(), std::length_error);
  const Snapshot then = world.snapshot();
  EXPECT_THROW(world.step(), std::length_error);
  world.restore(then);
  EXPECT_TRUE(measure(world).finite);
  for (Particle& p : near) p.position.x += 2;
  world.set_particles(1, near);
  world.step();
  EXPECT_EQ(world.last_step().seconds, world.frame_time());
}

/// A ball falls on a pinned one so fast that they meet within a frame. What has moved by then counts: another ball that
/// stands on the ground has been held by it, and all energy is accounted for.
TEST(MaxCandidates, EndAFrameEarlyIfItHasMoved) {
  Scene scene = lone_body(gas_ball());
  scene.gravity = {0, -2000, 0};
  scene.bodies[0].release = 1000;
  add_body(scene, {0, 1.15, 0}, {});
  add_body(scene, {5, 0, 0}, {});
  scene.contact_surface = ContactSurface::surfaces;
  set_solid(scene, {Ground{-0.6}});
  World whole(scene, {});
  whole.step();
  const std::size_t touching = WorldTestAccess::solver(whole).surface_contact().candidates().search().features().size();
  ASSERT_GT(touching, 1u);
  World world(scene, {.max_candidates = {.least = touching / 2, .per_particle = 0}});
  EnergyWatch watch;
  watch.look(world, measure_bodies(world));
  world.step();
  EXPECT_GT(world.last_step().substeps, 1);
  EXPECT_LT(world.last_step().seconds, world.frame_time());
  EXPECT_GT(glm::length(WorldTestAccess::solid_impulse(world, 2)), 0);
  EXPECT_FALSE(watch.look(world, measure_bodies(world))->from_nowhere());
  const std::uint64_t before = world.state_hash();
  EXPECT_THROW(world.step(), std::length_error);
  EXPECT_EQ(world.state_hash(), before) << "it is there from the start";
}

TEST(PenaltyContact, GrowsByTheSimulatedSecondsOfAShortFrame) {
  Scene scene = lone_body(gas_ball());
  add_body(scene, {5, 0, 0}, {});
  World world(scene, {.integrator = {"semi-implicit-euler"}, .budget = {.least = 4e6}});
  world.step();
  change(world, [&](Scene& s) { s.contact_surface = ContactSurface::surfaces; });  // after which it grows from nothing
  change(world, [&](Scene& s) { s.contact_surface = ContactSurface::vertices; });
  double grown = 0;
  for (int frame = 0; frame < 3; ++frame) {
    place(world, glm::dvec3(1.0), 1e5);
    world.step();
    ASSERT_LT(world.last_step().seconds, 0.5 * world.frame_time());
    grown += 0.05 * world.last_step().seconds;
    EXPECT_NEAR(double(WorldTestAccess::penalty_thickness(world)), grown, 1e-5 * grown) << frame;
  }
}

/// A body that is fast enough for its frames to be cut is calm for many of them, but for no time.
TEST(Sleep, DoesNotCountFramesThatAreCutShort) {
  Scene scene = lone_body(gas_ball());
  scene.sleep = {.speed = 0.05, .frames = 5};
  add_body(scene, {5, 0, 0}, {});
  World world(scene, {.integrator = {"semi-implicit-euler"}, .budget = {.least = 4e6}});
  for (int frame = 0; frame < 10; ++frame) {
    place(world, glm::dvec3(1.0), 1e6);
    world.step();
    ASSERT_LT(world.last_step().seconds, world.frame_time());
    ASSERT_FALSE(world.body(1).asleep) << frame;
  }
}

}  // namespace THIS_FILE
}  // namespace softbody::test
