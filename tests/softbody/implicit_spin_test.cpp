// Implicit steps of bodies that turn, in the air and on the ground.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "softbody/state/rigid_motion.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

RigidMotion rigid(const std::vector<Particle>& all) {
  return rigid_motion(
      all.size(), [&](std::size_t i) { return all[i].position; }, [&](std::size_t i) { return all[i].velocity; });
}

/// m/s, the root of the mean square of what is not rigid motion.
double internal_speed(const std::vector<Particle>& all) {
  const RigidMotion m = rigid(all);
  double sum = 0;
  for (const Particle& p : all) {
    const glm::dvec3 own = p.velocity - m.velocity - glm::cross(m.spin, p.position - m.centre);
    sum += glm::dot(own, own) / double(all.size());
  }
  return std::sqrt(sum);
}

void set_motion(World& world, const glm::dvec3& velocity, const glm::dvec3& spin) {
  std::vector<Particle> all = particles_of(world);
  const glm::dvec3 centre = rigid(all).centre;
  for (Particle& p : all) p.velocity = velocity + glm::cross(spin, p.position - centre);
  world.set_particles(0, all);
}

/// Steps along chords swell a body, leave its velocities behind, and drain its spin.
TEST(ImplicitSpin, GoesOnAsOnePiece) {
  const glm::dvec3 axis = glm::normalize(glm::dvec3(3, 18, -5));
  for (const double dt : {1.0 / 60, 1.0 / 240})
    for (const double stiffness : {1e5, 1e6, 1e8})
      for (const double spin : {2.0, 20.0}) {
        SCOPED_TRACE(testing::Message() << stiffness << " N/m, " << spin << " rad/s, " << dt << " s");
        World world(lone_body(gas_ball(stiffness)), {.frame_time = dt, .integrator = {"implicit", 1}});
        set_motion(world, glm::dvec3(0.0), spin * axis);
        const glm::dvec3 start = particles_of(world)[0].position;
        run(world, int(std::lround(1 / dt)));
        const std::vector<Particle> end = particles_of(world);
        EXPECT_LT(glm::distance(rigid(end).spin, spin * axis), 3e-4 * spin);
        EXPECT_LT(internal_speed(end), 3e-5) << "m/s";
        if (stiffness < 1e8) continue;
        const glm::dvec3 along = glm::dot(start, axis) * axis, out = start - along;
        const glm::dvec3 place = along + std::cos(spin) * out + std::sin(spin) * glm::cross(axis, out);
        EXPECT_LT(glm::distance(end[0].position, place), 1e-3) << "m";
      }
}

/// It swells as much as short explicit steps have it.
TEST(ImplicitSpin, SwellsAsItShould) {
  const auto radius = [](const char* integrator, double dt, int substeps) {
    World world(lone_body(gas_ball(1e3)), {.frame_time = dt, .integrator = {integrator, substeps}});
    set_motion(world, glm::dvec3(0.0), {0, 10, 0});
    run(world, int(std::lround(3 / dt)));
    double most = 0;
    for (const Particle& p : particles_of(world)) most = std::max(most, std::hypot(p.position.x, p.position.z));
    return most;
  };
  const double truth = radius("velocity-verlet", 1.0 / 60, 64);
  const World at_rest(lone_body(gas_ball(1e3)), {});
  double before = 0;
  for (const Particle& p : particles_of(at_rest)) before = std::max(before, std::hypot(p.position.x, p.position.z));
  ASSERT_GT(truth - before, 1e-3) << "m";
  EXPECT_NEAR(radius("implicit", 1.0 / 60, 1), truth, 0.05 * (truth - before));
}

/// Each particle of a body that spins, but that hardly anything holds together, flies straight on.
TEST(ImplicitSpin, LetsWhatIsFreeFlyStraight) {
  const auto error = [](int frames) {  // m, the root of the mean square after a quarter of a second
    Material loose = spring_ball();
    loose.set(StructuralSprings::keys, {1e-9, 0});
    loose.set(BendSprings::keys, {1e-9, 0});
    World world(lone_body(loose), {.frame_time = 0.25 / frames, .integrator = {"implicit", 1}});
    std::vector<Particle> start = particles_of(world);
    std::mt19937 random(3);
    for (Particle& p : start)
      p.velocity = glm::dvec3(0, 1, 2) + glm::cross(glm::dvec3(3, 1, -2), p.position) + random_vector(random, 1);
    world.set_particles(0, start);
    run(world, frames);
    const std::vector<Particle> end = particles_of(world);
    double sum = 0;
    for (std::size_t i = 0; i < end.size(); ++i) {
      const glm::dvec3 off = end[i].position - start[i].position - 0.25 * start[i].velocity;
      sum += glm::dot(off, off) / double(end.size());
    }
    return std::sqrt(sum);
  };
  const double before = error(16), after = error(32);
  EXPECT_LT(before, 0.001);
  EXPECT_GT(std::log2(before / after), 1.65) << before << " m, then " << after << " m";
}

TEST(ImplicitSpin, RollsOn) {
  for (const double stiffness : {1e5, 1e7}) {
    Scene scene = lone_body(gas_ball(stiffness));
    scene.gravity = {0, -9.81, 0};
    set_solid(scene, {Ground{}});
    scene.bodies[0].position = {0, 0.6, 0};
    World world(scene, {.integrator = {"implicit", 1}});
    run(world, 90);
    const double height = rigid(particles_of(world)).centre.y;
    set_motion(world, {20 * height, 0, 0}, {0, 0, -20});
    const double energy = measure(world).energy;
    for (int frame = 0; frame < 60; ++frame) {
      world.step();
      ASSERT_LT(measure(world).energy, energy + 0.01 * 9.81) << stiffness << " N/m, frame " << frame;
    }
    const RigidMotion end = rigid(particles_of(world));
    EXPECT_NEAR(end.spin.z, -20, 0.5) << stiffness;
    EXPECT_NEAR(end.velocity.x, 20 * height, 0.5) << stiffness;
  }
}

/// A slender strip, crumpled and tumbling: springs, and what takes back energy, leave both momenta alone.
TEST(ImplicitSpin, KeepsMomentumInTheAir) {
  for (const double stiffness : {1e2, 1e4, 1e6})
    for (const double width : {0.05, 0.01})
      for (unsigned seed = 1; seed <= 5; ++seed) {
        SCOPED_TRACE(testing::Message() << stiffness << " N/m, " << width << " m wide, seed " << seed);
        Material m;
        m.set(StructuralSprings::keys, {stiffness, 0.1});
        m.set(ShearSprings::keys, {stiffness / 2, 0.1});
        m.set(BendSprings::keys, {stiffness / 10, 0.1});
        Scene scene = lone_body(m);
        scene.bodies[0].mesh = {.kind = "grid", .columns = 30, .rows = 1, .width = 2, .depth = width};
        World world(scene, {.integrator = {"implicit", 1}});
        std::mt19937 random(seed);
        std::vector<Particle> all = particles_of(world);
        for (Particle& p : all)
          p.velocity = glm::cross(glm::dvec3(0, 1, 10), p.position) +
                       glm::dvec3{uniform(random, 0, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
        world.set_particles(0, all);
        const RigidMotion before = rigid(particles_of(world));
        const double energy = measure(world).energy;
        for (int frame = 0; frame < 60; ++frame) {
          world.step();
          ASSERT_LT(measure(world).energy, energy + 0.1) << "J, frame " << frame;
        }
        const RigidMotion after = rigid(particles_of(world));
        EXPECT_LT(glm::distance(after.velocity, before.velocity), 1e-5);
        EXPECT_LT(glm::distance(after.momentum, before.momentum), 1e-4 * glm::length(before.momentum));
      }
}

/// What throws it back is its fall, not its spin.
TEST(ImplicitSpin, LeavesASmoothSolidNoFasterThanItShould) {
  for (const double dt : {1.0 / 60, 1.0 / 240})
    for (const double stiffness : {1e4, 1e6})
      for (const double spin : {0.0, 40.0, 80.0}) {
        SCOPED_TRACE(testing::Message() << stiffness << " N/m, " << spin << " rad/s, " << dt << " s");
        Scene scene = lone_body(gas_ball(stiffness));
        scene.gravity = {0, -9.81, 0};
        set_solid(scene, {Ground{}});
        solid_of<Ground>(scene).friction = 0, solid_of<Ground>(scene).restitution = 0.8;
        scene.bodies[0].position = {0, 2, 0};
        World world(scene, {.frame_time = dt, .integrator = {"implicit", 1}});
        set_motion(world, glm::dvec3(0.0), {0, 0, spin});
        const double energy = measure(world).energy;
        double fastest = 0;
        for (int frame = 0; frame * dt < 1; ++frame) {
          world.step();
          const Measures m = measure(world);
          ASSERT_TRUE(m.finite) << frame;
          ASSERT_LT(m.energy, energy + 0.2) << "J, frame " << frame;
          fastest = std::max(fastest, rigid(particles_of(world)).velocity.y);
        }
        if (stiffness < 1e6) continue;  // it swings, too
        // At 80 rad/s its corners beat on the ground, and some of what contact takes of the spin comes back, too.
        EXPECT_LT(fastest, spin < 80 ? 4.6 : 5.3) << "m/s; it comes with 5.3";
      }
}

}  // namespace THIS_FILE
}  // namespace softbody::test
