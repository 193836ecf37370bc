// Implicit steps of bodies that turn, in the air and off the ground.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

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
    for (const double stiffness : {1e5, 1e8})
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

/// What throws it back is its fall, not its spin.
TEST(ImplicitSpin, LeavesASmoothSolidNoFasterThanItShould) {
  for (const double spin : {0.0, 40.0, 80.0}) {
    SCOPED_TRACE(testing::Message() << spin << " rad/s");
    Scene scene = lone_body(gas_ball(1e6));
    scene.gravity = {0, -9.81, 0};
    set_solid(scene, {Ground{0}, 0, 0.8});
    scene.bodies[0].position = {0, 2, 0};
    World world(scene, {.integrator = {"implicit", 1}});
    set_motion(world, glm::dvec3(0.0), {0, 0, spin});
    const double energy = measure(world).energy;
    double fastest = 0;
    for (int frame = 0; frame < 60; ++frame) {
      world.step();
      const Measures m = measure(world);
      ASSERT_TRUE(m.finite) << frame;
      ASSERT_LT(m.energy, energy + 0.2) << "J, frame " << frame;
      fastest = std::max(fastest, rigid(particles_of(world)).velocity.y);
    }
    // At 80 rad/s its corners beat on the ground, and some of what contact takes of the spin comes back, too.
    EXPECT_LT(fastest, spin < 80 ? 4.6 : 5.3) << "m/s; it comes with 5.3";
  }
}

}  // namespace THIS_FILE
}  // namespace softbody::test
