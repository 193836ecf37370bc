// What a frame may be at most: its substeps, their work, and what is found at once; the rest of it is left out.

#include <gtest/gtest.h>

#include "softbody/world/snapshot.h"
#include "tests/softbody/helpers.h"
#include "tests/support/world_test_access.h"

namespace softbody::test {
namespace {

TEST(StepController, CutsAFrameShortAtTheMaximumOfSubsteps) {
  World world(lone_body(gas_ball()), {.integrator = {"semi-implicit-euler"}});
  world.step();
  EXPECT_EQ(world.last_step().seconds, world.frame_time());
  place(world, glm::dvec3(1.0), 1e6);
  for (int frame = 0; frame < 3; ++frame) {
    world.step();
    EXPECT_EQ(world.last_step().substeps, max_substeps);
    EXPECT_GT(world.last_step().seconds, 0);
    EXPECT_LT(world.last_step().seconds, world.frame_time());
    EXPECT_TRUE(measure(world).finite);
  }
  World fixed(lone_body(gas_ball()), {.integrator = {"semi-implicit-euler", max_substeps + 1}});
  fixed.step();
  EXPECT_EQ(fixed.last_step().seconds, fixed.frame_time()) << "who fixes substeps gets them";
}

/// A world of twice the particles gets half the substeps.
TEST(StepController, TakesFewerSubstepsInLargeWorldsOfAWindow) {
  const auto most = [](double particles) {
    World world(lone_body(gas_ball()),
                {.integrator = {"semi-implicit-euler"}, .max_work = {.max_counted_particles = particles}});
    place(world, glm::dvec3(1.0), 1e6);
    world.step();
    return world.last_step().substeps;
  };
  EXPECT_EQ(most(162), max_substeps) << "it has no more, whatever room its batch has";
  EXPECT_LT(most(100), max_substeps);
  EXPECT_NEAR(most(100), 2 * most(50), 1);
  EXPECT_EQ(most(0), 1);
}

TEST(StepController, LimitsTheWorkOfImplicitSteps) {
  Scene scene = lone_body(spring_ball());
  scene.ground.emplace();
  const auto step = [&](double work, std::optional<int> substeps) {
    World world(scene, {.integrator = {"implicit", substeps}, .max_work = {.implicit = work}});
    place(world, glm::dvec3(1.0), 500);
    world.step();
    return world.last_step();
  };
  const StepReport whole = step(1e9, {}), part = step(1e4, {});
  ASSERT_GT(whole.substeps, 32);
  EXPECT_EQ(whole.seconds, 1.0 / 60);
  EXPECT_LE(part.substeps, 16);
  EXPECT_LT(part.seconds, whole.seconds);
  EXPECT_EQ(step(1, {}).substeps, 1);
  EXPECT_EQ(step(1e4, whole.substeps).seconds, whole.seconds) << "who fixes them gets them";
}

TEST(StepController, TakesFewerImplicitSteps) {
  Scene scene = lone_body(spring_ball());
  scene.bodies[0].mesh.subdivisions = 0;
  scene.ground.emplace();
  World world(scene, {.integrator = {"implicit"}});
  place(world, glm::dvec3(1.0), 1e5);
  world.step();
  EXPECT_EQ(world.last_step().substeps, max_implicit_steps);
  EXPECT_GT(world.last_step().seconds, 0);
  EXPECT_LT(world.last_step().seconds, world.frame_time());
  EXPECT_EQ(world.last_step().time, world.last_step().seconds);
}

/// One body in another of its kind: each penalty pair is worked out for the bound of the first substeps, in the
/// first of them, in the others for which that bound may be trusted, and so on.
TEST(StepController, LimitsTheWorkOfPenaltyPairs) {
  Scene scene = lone_body(gas_ball(), {0, 5, 0});
  add_body(scene, {0.3, 0, 0}, {});
  scene.gravity = {};
  const auto of_work = [&](double pairs, std::optional<int> substeps) {
    World world(scene, {.integrator = {"semi-implicit-euler", substeps}, .max_work = {.penalty = pairs}});
    world.step();
    EXPECT_TRUE(measure(world).finite);
    return world;
  };
  const World whole = of_work(1e9, {});
  const double pairs = double(WorldTestAccess::solver(whole).penalty_contact().pairs.size());
  ASSERT_GT(pairs, 10);
  ASSERT_EQ(whole.last_step().seconds, whole.frame_time());
  const auto substeps = [&](double times) { return of_work(times * pairs, {}).last_step().substeps; };
  EXPECT_EQ(substeps(0), 1);
  EXPECT_EQ(substeps(2), 1) << "a bound and a substep";
  const int trusted = substeps(2.01);
  EXPECT_GT(trusted, 1);
  EXPECT_LT(trusted, whole.last_step().substeps);
  EXPECT_EQ(substeps(1 + trusted), trusted);
  const int next = substeps(1 + trusted + 0.01);
  EXPECT_GT(next, trusted);
  EXPECT_EQ(substeps(1 + next + 0.5), next) << "two bounds";
  EXPECT_GT(substeps(2 + next + 0.01), next);
  EXPECT_LT(of_work(0, {}).last_step().seconds, whole.frame_time());
  EXPECT_EQ(of_work(0, whole.last_step().substeps).last_step().seconds, whole.frame_time())
      << "who fixes them gets them";
}

/// Two bodies side by side in contact of their surfaces.
Scene touching_surfaces() {
  Scene scene = lone_body(gas_ball());
  add_body(scene, {0.99, 0, 0}, {});
  scene.contact_surface = ContactSurface::surfaces;
  return scene;
}

TEST(StepController, LimitsTheWorkOfSurfaceContact) {
  const std::string integrator = "semi-implicit-euler";
  World whole(touching_surfaces(), {.integrator = {integrator}});
  whole.step();
  EXPECT_EQ(whole.last_step().seconds, whole.frame_time());
  ASSERT_GT(whole.last_step().substeps, 8);
  const auto of_work = [&](double bound) {
    World world(touching_surfaces(), {.integrator = {integrator}, .max_work = {.surface = bound}});
    world.step();
    EXPECT_NEAR(world.last_step().seconds / world.frame_time(),
                double(world.last_step().substeps) / whole.last_step().substeps, 0.05);
    return world;
  };
  const auto of_substep = [](const World& world) {
    return WorldTestAccess::solver(world).surface_contact().work_of_substep();
  };
  // Candidates are found once, and looked at in one substep after the other; four are taken at a time, first one of
  // them.
  const World one = of_work(0);
  EXPECT_EQ(one.last_step().substeps, 1);
  const collide::surface::SurfaceSearch& search = WorldTestAccess::solver(one).surface_contact().candidates().search();
  const double half = 0.5 * double(search.features().size()), least = of_substep(one);
  ASSERT_GT(half, 0);
  EXPECT_GT(double(search.work()), 2 * half);
  EXPECT_GT(least, 2 * half) << "contacts are solved";
  double work = double(search.work()) + least;
  EXPECT_EQ(of_work(work).last_step().substeps, 1);
  const World four = of_work(work + half);
  EXPECT_EQ(four.last_step().substeps, 4);
  work += 3 * of_substep(four);
  EXPECT_EQ(of_work(work).last_step().substeps, 4);
  EXPECT_EQ(of_work(work + half).last_step().substeps, 8);

  World fixed(touching_surfaces(), {.integrator = {integrator, 20}, .max_work = {.surface = 0}});
  fixed.step();
  EXPECT_EQ(fixed.last_step().seconds, fixed.frame_time());
}

/// Surfaces that pass each other fast have their candidates found anew many times in a frame, which shows in what it
/// took; where that is exactly what it took before, it is missed here.
TEST(StepController, LimitsTheWorkOfSearchesForSurfaceContact) {
  Scene scene = lone_body(gas_ball(), {50, 0, 0});
  add_body(scene, {1.5, 0, 0}, {-50, 0, 0});
  scene.contact_surface = ContactSurface::surfaces;
  struct Work {
    double found = 0, looked_at = 0, seconds = 0;
    double all() const { return found + looked_at; }
  };
  const auto work = [&](double bound) {
    World world(scene, {.integrator = {"semi-implicit-euler"}, .max_work = {.surface = bound}});
    const SurfaceContact& contact = WorldTestAccess::solver(world).surface_contact();
    Work result;
    std::size_t last = 0;
    world.step([&] {
      const std::size_t now = contact.candidates().search().work();
      if (now != last) result.found += double(now);
      last = now;
      result.looked_at += contact.work_of_substep();
    });
    result.seconds = world.last_step().seconds;
    return result;
  };
  const Work whole = work(1e9);
  ASSERT_GT(whole.found, 0.2 * whole.all());
  for (const double part : {0.25, 0.5, 0.75}) {
    const Work bound = work(part * whole.all());
    EXPECT_NEAR(bound.all() / whole.all(), part, 0.05);
    EXPECT_LT(bound.seconds, whole.seconds);
  }
}

/// The bounds are those of a world of 10,000 particles. Who is held is not stepped, but is one of them.
TEST(StepController, AllowsWorkInProportionToTheWorld) {
  const auto substeps = [](Scene scene, std::size_t held, const World::Options& options) {
    BodySource body = scene.bodies[0];
    body.mesh.subdivisions = 3;  // 642 particles
    body.release = 10;
    for (std::size_t i = 0; i < held; ++i) {
      body.position = {2.0 * double(i), 0, 10};
      scene.bodies.push_back(body);
    }
    World world(scene, options);
    world.step();
    EXPECT_LT(world.last_step().seconds, world.frame_time());
    return world.last_step().substeps;
  };
  Scene fast = lone_body(spring_ball(), {0, -500, 0});
  fast.bodies[0].position.y = 0.6;  // above the ground
  fast.ground.emplace();
  const auto implicit = [&](std::size_t held, double work) {
    return substeps(fast, held, {.integrator = {"implicit"}, .max_work = {.implicit = work}});
  };
  const auto surface = [&](std::size_t held, double work) {
    return substeps(touching_surfaces(), held, {.integrator = {"semi-implicit-euler"}, .max_work = {.surface = work}});
  };
  EXPECT_EQ(implicit(8, 4e4), implicit(0, 4e4)) << "5,298 particles";
  EXPECT_EQ(surface(8, 8e3), surface(0, 8e3));
  // 41,250 particles.
  EXPECT_GE(implicit(64, 1e4), implicit(0, 4e4));
  EXPECT_LE(implicit(64, 1e4), implicit(0, 4.5e4));
  EXPECT_GE(surface(64, 2e3), surface(0, 8e3));
  EXPECT_LE(surface(64, 2e3), surface(0, 9e3));
  EXPECT_LT(implicit(0, 1e4), implicit(0, 4e4));
  EXPECT_LT(surface(0, 2e3), surface(0, 8e3));
}

/// In none of them do surfaces pass each other by more than 0.15 edges.
TEST(StepController, TakesSubstepsForBodiesThatPass) {
  constexpr double speed = 100;  // m/s, towards each other
  Scene scene = lone_body(gas_ball(), {speed / 2, 0, 0});
  add_body(scene, {2, 0, 0}, {-speed / 2, 0, 0});
  scene.contact_surface = ContactSurface::surfaces;
  World world(scene, {.integrator = {"semi-implicit-euler"}});
  world.step();
  EXPECT_GE(world.last_step().substeps, speed * world.frame_time() / (0.15 * world.model(0).mean_edge));
  scene.contact_surface = ContactSurface::vertices;
  World without(scene, {.integrator = {"semi-implicit-euler"}});
  without.step();
  EXPECT_LT(without.last_step().substeps, world.last_step().substeps / 2);
}

/// Of 96 bytes each: what a world may hold must not grow beyond what a machine does.
TEST(StepController, AllowsMoreCandidatesInLargerWorldsUpToALimit) {
  const MaxWork work;
  EXPECT_EQ(work.candidates(1000), std::size_t{1} << 24);
  EXPECT_EQ(work.candidates(400'000), 64u * 400'000);
  EXPECT_EQ(work.candidates(4'000'000), std::size_t{1} << 25);
}

/// Those that were found before belong to another moment: nothing may look at them.
TEST(StepController, EndsTheFrameAtTooManyCandidates) {
  const auto candidates = [](const World& world) {
    return double(WorldTestAccess::solver(world).surface_contact().candidates().search().features().size());
  };
  World touching(touching_surfaces(), {});
  touching.step();
  World world(touching_surfaces(), {.max_work = {.at_once = 1.5 * candidates(touching)}});
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

TEST(PenaltyContact, GrowsByTheSimulatedSecondsOfAShortFrame) {
  Scene scene = lone_body(gas_ball());
  add_body(scene, {5, 0, 0}, {});
  World world(scene, {.integrator = {"semi-implicit-euler"}});
  world.step();
  world.set_contact_surface(ContactSurface::surfaces);  // after which it grows from nothing
  world.set_contact_surface(ContactSurface::vertices);
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
  scene.sleep = {.speed = 0.05};
  add_body(scene, {5, 0, 0}, {});
  World world(scene, {.integrator = {"semi-implicit-euler"}});
  for (int frame = 0; frame < 40; ++frame) {
    place(world, glm::dvec3(1.0), 1e6);
    world.step();
    ASSERT_LT(world.last_step().seconds, world.frame_time());
    ASSERT_FALSE(world.body(1).asleep) << frame;
  }
}

}  // namespace
}  // namespace softbody::test
