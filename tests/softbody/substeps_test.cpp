// A frame's substeps: as many as the bound asks for as bodies change, and no more than there may be.

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "softbody/snapshot.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace {

TEST(Substeps, AreThoseOfTheBodyThatNeedsMost) {
  Scene scene = lone_body(gas_ball());
  for (int i = 1; i < 3; ++i) {
    scene.bodies.push_back(scene.bodies[0]);
    scene.bodies[std::size_t(i)].position.x += 5 * i;
  }
  World world(scene, {.integrator = "semi-implicit-euler"});
  for (const double size : {1.0, 0.6}) {  // of the second body
    double most = 0;
    for (BodyId body = 0; body < 3; ++body) {
      std::vector<Particle> particles;
      std::vector<glm::dvec3> x;
      for (Index v = 0; v < world.prototype(body).mesh.vertices.size(); ++v) {
        particles.push_back(world.dynamics().particle(body, v));
        if (body == 1)
          particles.back().position = world.body(1).origin + size * (particles.back().position - world.body(1).origin);
        x.push_back(particles.back().position);
      }
      world.set_particles(body, particles);
      const Prototype& p = world.prototype(body);
      const double step = world.integrator().stable_step(stiffness_per_mass(p, measure_surface(p, x)),
                                                         p.spring_damping_bound / p.particle_mass);
      most = std::max(most, world.frame_time() / step);
    }
    EXPECT_NEAR(world.dynamics().substeps(100 * world.frame_time()), 100 * most, 1) << size;
  }
}

/// What damps their contact is the most for the lighter one.
TEST(Substeps, AreThoseOfTheLighterBodyOfAPairWhicheverComesFirst) {
  const auto substeps = [](double first, double second) {
    Scene scene = lone_body(spring_ball());
    scene.materials.push_back(scene.materials[0]);
    scene.materials[0].mass = first, scene.materials[1].mass = second;
    for (Material& m : scene.materials) m.contact_stiffness = 1000;
    add_body(scene, {0, 1.02, 0}, glm::dvec3(0.0));
    scene.bodies[1].material = 1;
    World world(scene, {.integrator = "semi-implicit-euler"});
    world.step();
    return world.profile().substeps;
  };
  const int lighter_first = substeps(0.5, 50);
  EXPECT_GT(lighter_first, 3 * substeps(50, 50));
  EXPECT_NEAR(substeps(50, 0.5), lighter_first, 0.05 * lighter_first);
}

TEST(Substeps, FollowABodyThatIsCrushedWithinAFrame) {
  for (const double speed : {30.0, 100.0, 300.0, 1000.0}) {
    Scene scene = lone_body(gas_ball(), {0, -speed, 0});
    scene.bodies[0].position = {0, 1, 0};
    scene.ground.emplace();
    World world(scene, {});
    const double energy = measure(world).energy;
    for (int frame = 0; frame < 60; ++frame) {
      world.step();
      const Measures m = measure(world);
      ASSERT_TRUE(m.finite) << speed << " m/s, frame " << frame;
      EXPECT_LT(m.energy, energy + 1e-3 * speed * speed) << speed << " m/s, frame " << frame;
      EXPECT_LT(m.max_speed, 3 * speed) << speed << " m/s, frame " << frame;
    }
  }
}

/// The body in its starting shape, so many times as large along each axis, with velocities in proportion.
void place(World& world, const glm::dvec3& scale, double rate = 0) {
  std::vector<Particle> particles;
  for (const glm::dvec3& x : world.prototype(0).start) particles.push_back({scale * x, rate * x});
  world.set_particles(0, particles);
}

/// At rest, but far from its balance: no speed tells yet how soon it will have another shape, and another bound. Then
/// it is fast: a step by the bound of its present shape would lead right through its own far side.
TEST(Substeps, FollowABodyThatSnapsBack) {
  for (const double stretch : {2.0, 3.0, 5.0, 10.0, 20.0, 50.0})
    for (const double stiffness : {1e1, 1e2, 1e3, 1e4})
      for (const double frame_time : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
        Material m = gas_ball();
        m.structural = {stiffness, 0.1};
        m.bend = {stiffness / 4, 0.1};
        m.gas_pressure = 1.6 * stiffness;
        m.ambient_pressure = 0;
        World world(lone_body(m), {.frame_time = frame_time});
        place(world, {stretch, 1, 1});
        const double most = 1.05 * measure(world).energy;
        for (int frame = 0; frame < 30; ++frame) {
          world.step();
          ASSERT_LE(measure(world).energy, most)
              << stretch << " times, " << stiffness << " N/m, frame " << frame << " of " << frame_time << " s";
        }
      }
}

/// As small as a scene file may have it: a frame in which it keeps up with the ground takes more than 1e9 substeps. One
/// of the whole frame, in their place, threw all others apart.
TEST(Substeps, AreNotTooLongForAnyBodyWhereOneAsksForMoreThanCanBe) {
  Scene scene = lone_body(gas_ball());
  scene.gravity = {0, -9.81, 0};
  scene.ground = Ground{};
  scene.contact_surface = ContactSurface::surfaces;
  add_body(scene, {3, 0.1, 0}, {0, -10, 0});
  scene.bodies[1].mesh.radius = 1e-9;
  World world(scene, {});
  for (int frame = 0; frame < 5; ++frame) {
    world.step();
    ASSERT_LE(world.profile().substeps, World::max_substeps);
    ASSERT_LT(world.profile().seconds, world.frame_time());
    ASSERT_LT(measure(world).max_speed, 11) << "frame " << frame;
    ASSERT_LT(measure(world, 0).largest_strain, 0.1) << "frame " << frame;
  }
}

TEST(Substeps, OfAFrameAreBoundAndTheRestOfItIsLeftOut) {
  World world(lone_body(gas_ball()), {.integrator = "semi-implicit-euler"});
  world.step();
  EXPECT_EQ(world.profile().seconds, world.frame_time());
  place(world, glm::dvec3(1.0), 1e6);
  for (int frame = 0; frame < 3; ++frame) {
    world.step();
    EXPECT_EQ(world.profile().substeps, World::max_substeps);
    EXPECT_GT(world.profile().seconds, 0);
    EXPECT_LT(world.profile().seconds, world.frame_time());
    EXPECT_TRUE(measure(world).finite);
  }
  World fixed(lone_body(gas_ball()), {.integrator = "semi-implicit-euler", .substeps = World::max_substeps + 1});
  fixed.step();
  EXPECT_EQ(fixed.profile().seconds, fixed.frame_time()) << "who fixes substeps gets them";
}

TEST(Substeps, ThatAreImplicitAreBoundByTheirWork) {
  Scene scene = lone_body(spring_ball());
  scene.ground.emplace();
  const auto step = [&](double work, std::optional<int> substeps) {
    World world(scene, {.integrator = "implicit", .substeps = substeps, .max_work = {.implicit = work}});
    place(world, glm::dvec3(1.0), 500);
    world.step();
    return world.profile();
  };
  const Profile whole = step(1e9, {}), part = step(1e4, {});
  ASSERT_GT(whole.substeps, 32);
  EXPECT_EQ(whole.seconds, 1.0 / 60);
  EXPECT_LE(part.substeps, 16);
  EXPECT_LT(part.seconds, whole.seconds);
  EXPECT_EQ(step(1, {}).substeps, 1);
  EXPECT_EQ(step(1e4, whole.substeps).seconds, whole.seconds) << "who fixes them gets them";
}

TEST(Substeps, ThatAreImplicitAreFewer) {
  Scene scene = lone_body(spring_ball());
  scene.bodies[0].mesh.subdivisions = 0;
  scene.ground.emplace();
  World world(scene, {.integrator = "implicit"});
  place(world, glm::dvec3(1.0), 1e5);
  world.step();
  EXPECT_EQ(world.profile().substeps, Dynamics::max_implicit_steps);
  EXPECT_GT(world.profile().seconds, 0);
  EXPECT_LT(world.profile().seconds, world.frame_time());
  EXPECT_EQ(world.time(), world.profile().seconds);
}

/// Two bodies side by side in contact of their surfaces.
Scene touching_surfaces() {
  Scene scene = lone_body(gas_ball());
  add_body(scene, {0.99, 0, 0}, {});
  scene.contact_surface = ContactSurface::surfaces;
  return scene;
}

TEST(Substeps, OfSurfaceContactAreBoundByTheirWork) {
  const std::string integrator = "semi-implicit-euler";
  World whole(touching_surfaces(), {.integrator = integrator});
  whole.step();
  EXPECT_EQ(whole.profile().seconds, whole.frame_time());
  ASSERT_GT(whole.profile().substeps, 8);
  const auto of_work = [&](double bound) {
    World world(touching_surfaces(), {.integrator = integrator, .max_work = {.surface = bound}});
    world.step();
    EXPECT_NEAR(world.profile().seconds / world.frame_time(),
                double(world.profile().substeps) / whole.profile().substeps, 0.05);
    return world;
  };
  const auto of_substep = [](const World& world) {
    const Profile& p = world.profile();
    return world.dynamics().surface_contact().work_of_substep(float(p.seconds / p.substeps));
  };
  // Candidates are found once, and looked at in one substep after the other; four are taken at a time, first one of
  // them.
  const World one = of_work(0);
  EXPECT_EQ(one.profile().substeps, 1);
  const collide::SurfaceSearch& search = one.dynamics().surface_contact().search();
  const double half = 0.5 * double(search.features().size()), least = of_substep(one);
  ASSERT_GT(half, 0);
  EXPECT_GT(double(search.work()), 2 * half);
  EXPECT_GT(least, 2 * half) << "contacts are solved";
  double work = double(search.work()) + least;
  EXPECT_EQ(of_work(work).profile().substeps, 1);
  const World four = of_work(work + half);
  EXPECT_EQ(four.profile().substeps, 4);
  work += 3 * of_substep(four);
  EXPECT_EQ(of_work(work).profile().substeps, 4);
  EXPECT_EQ(of_work(work + half).profile().substeps, 8);

  World fixed(touching_surfaces(), {.integrator = integrator, .substeps = 20, .max_work = {.surface = 0}});
  fixed.step();
  EXPECT_EQ(fixed.profile().seconds, fixed.frame_time());
}

/// The bounds are those of a world of 10,000 particles. Who is held is not stepped, but is one of them.
TEST(Substeps, OfALargerWorldMayBeMoreWorkInProportion) {
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
    EXPECT_LT(world.profile().seconds, world.frame_time());
    return world.profile().substeps;
  };
  Scene fast = lone_body(spring_ball(), {0, -500, 0});
  fast.ground.emplace();
  const auto implicit = [&](std::size_t held, double work) {
    return substeps(fast, held, {.integrator = "implicit", .max_work = {.implicit = work}});
  };
  const auto surface = [&](std::size_t held, double work) {
    return substeps(touching_surfaces(), held, {.integrator = "semi-implicit-euler", .max_work = {.surface = work}});
  };
  EXPECT_EQ(implicit(8, 4e4), implicit(0, 4e4)) << "5,298 particles";
  EXPECT_EQ(surface(8, 8e3), surface(0, 8e3));
  // 41,250 particles, 42,384 with lanes that no body takes.
  EXPECT_GE(implicit(64, 1e4), implicit(0, 4e4));
  EXPECT_LE(implicit(64, 1e4), implicit(0, 4.5e4));
  EXPECT_GE(surface(64, 2e3), surface(0, 8e3));
  EXPECT_LE(surface(64, 2e3), surface(0, 9e3));
  EXPECT_LT(implicit(0, 1e4), implicit(0, 4e4));
  EXPECT_LT(surface(0, 2e3), surface(0, 8e3));
}

/// In none of them do surfaces pass each other by more than 0.15 edges.
TEST(Substeps, OfSurfaceContactKeepUpWithWhatPasses) {
  constexpr double speed = 100;  // m/s, towards each other
  Scene scene = lone_body(gas_ball(), {speed / 2, 0, 0});
  add_body(scene, {2, 0, 0}, {-speed / 2, 0, 0});
  scene.contact_surface = ContactSurface::surfaces;
  World world(scene, {.integrator = "semi-implicit-euler"});
  world.step();
  EXPECT_GE(world.profile().substeps, speed * world.frame_time() / (0.15 * world.prototype(0).mean_edge));
  scene.contact_surface = ContactSurface::vertices;
  World without(scene, {.integrator = "semi-implicit-euler"});
  without.step();
  EXPECT_LT(without.profile().substeps, world.profile().substeps / 2);
}

/// Those that were found before belong to another moment: nothing may look at them.
TEST(Substeps, TooManyCandidatesAtOnceEndTheFrameAndTheWorldCanGoOn) {
  const auto candidates = [](const World& world) {
    return double(world.dynamics().surface_contact().search().features().size());
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
  EXPECT_EQ(world.profile().seconds, world.frame_time());
}

/// A body that is fast enough for its frames to be cut is calm for many of them, but for no time.
TEST(Sleep, DoesNotCountFramesThatAreCutShort) {
  Scene scene = lone_body(gas_ball());
  scene.sleep = {.speed = 0.05};
  add_body(scene, {5, 0, 0}, {});
  World world(scene, {.integrator = "semi-implicit-euler"});
  for (int frame = 0; frame < 40; ++frame) {
    place(world, glm::dvec3(1.0), 1e6);
    world.step();
    ASSERT_LT(world.profile().seconds, world.frame_time());
    ASSERT_FALSE(world.body(1).asleep) << frame;
  }
}

TEST(Substeps, FollowTheBound) {
  Scene scene = lone_body(spring_ball());
  for (const double stiffness : {10.0, 300.0, 30000.0}) {
    scene.materials[0].structural.stiffness = stiffness;
    World world(scene, {});
    const Prototype& p = world.prototype(0);
    world.step();
    const double h = stable_step(p.spring_stiffness_bound / p.particle_mass, p.spring_damping_bound / p.particle_mass);
    EXPECT_EQ(world.profile().substeps, int(std::ceil(1.0 / 60 / h)));
  }
}

TEST(Substeps, AFrameThatWouldNeedTooManyIsAnError) {
  Scene scene = lone_body(spring_ball());
  scene.materials[0].structural.stiffness = 1e9;
  try {
    World world(scene, {.integrator = "semi-implicit-euler"});
    FAIL() << "took it";
  } catch (const SceneError& e) {
    EXPECT_NE(std::string(e.what()).find("'springs'"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("4000"), std::string::npos) << e.what();
  }
}

/// A hard throw against a solid: however it deforms, the step that was chosen has to carry it.
TEST(Substeps, KeepABodyThatIsCrushedInOnePiece) {
  for (const double speed : {3.0, 10.0, 30.0}) {
    Scene scene = lone_body(gas_ball(), glm::dvec3(0, -speed, 0));
    scene.bodies[0].position = {0, 1, 0};
    scene.ground = Ground{};
    World world(scene, {});
    const double before = measure(world).energy, kinetic = 0.5 * speed * speed;
    for (int i = 0; i < 120; ++i) {
      world.step();
      const Measures m = measure(world);
      ASSERT_TRUE(m.finite) << "frame " << i;
      ASSERT_LT(m.max_speed, 3 * speed);
      ASSERT_LT(m.energy, before + 0.1 * kinetic) << "frame " << i << " at " << speed << " m/s";
    }
    EXPECT_GT(measure(world).volume_ratio_min, 0.9);
  }
}

}  // namespace
}  // namespace softbody::test
