// The momenta of stiff bodies, of which explicit steps in floats lose a part at every step: what nothing touches keeps
// them, and what is touched does not.

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

struct Flight {
  std::string name, integrator;
  std::optional<int> substeps;
  bool conserves_spin;
};

class StiffBodyInFreeFlight : public testing::TestWithParam<Flight> {};

TEST_P(StiffBodyInFreeFlight, KeepsItsMomenta) {
  const Flight& flight = GetParam();
  Scene scene = lone_body(gas_ball(1e6, 0.02));
  scene.gravity = {0, -9.81, 0};
  World world(scene, {.integrator = {flight.integrator, flight.substeps}});
  std::vector<Particle> start = particles_of(world);
  for (Particle& p : start) p.velocity = glm::dvec3(1, 2, 0.5) + glm::cross(glm::dvec3(0.5, 3, 1), p.position);
  world.set_particles(0, start);
  const Motion before = motion(world, 0);
  for (int frame = 1; frame <= 60; ++frame) {
    world.step();
    const Motion now = motion(world, 0);
    const glm::dvec3 velocity = before.velocity + frame / 60.0 * scene.gravity;
    ASSERT_GE(world.last_step().substeps, 64);
    ASSERT_LT(glm::distance(now.velocity, velocity), 1e-5 * glm::length(before.velocity)) << "frame " << frame;
    if (!flight.conserves_spin) continue;
    ASSERT_LT(glm::distance(now.spin_momentum, before.spin_momentum), 2e-6 * glm::length(before.spin_momentum))
        << "frame " << frame;
  }
}

INSTANTIATE_TEST_SUITE_P(By, StiffBodyInFreeFlight,
                         testing::Values(Flight{"semi_implicit_euler", "semi-implicit-euler", std::nullopt, true},
                                         Flight{"semi_implicit_euler_in_short_steps", "semi-implicit-euler", 1024,
                                                true},
                                         Flight{"velocity_verlet", "velocity-verlet", std::nullopt, true},
                                         Flight{"rk4", "rk4", std::nullopt, false}),
                         [](const auto& one) { return one.param.name; });

/// Explicit steps of a method that changes the angular momentum itself show it, however many they are.
TEST(ExplicitEuler, ShowsWhatItDoesToTheSpin) {
  World world(lone_body(gas_ball(1e3, 0.02)), {.integrator = {"explicit-euler", 512}});
  std::vector<Particle> start = particles_of(world);
  for (Particle& p : start) p.velocity = glm::cross(glm::dvec3(0.5, 3, 1), p.position);
  world.set_particles(0, start);
  const Motion before = motion(world, 0);
  run(world, 15);
  EXPECT_GT(glm::distance(motion(world, 0).spin_momentum, before.spin_momentum),
            1e-5 * glm::length(before.spin_momentum));
}

constexpr double stiffness = 1e5;
const World::Options explicit_steps{.integrator = {"semi-implicit-euler", 200}};

TEST(StiffBody, ThatIsHeldGetsNoMomentumBesideOneThatFalls) {
  Scene scene = lone_body(gas_ball(stiffness));
  scene.gravity = {0, -9.81, 0};
  add_body(scene, {3, 0, 0}, glm::dvec3(0.0));
  scene.bodies[1].release = 1000;
  World world(scene, explicit_steps);
  run(world, 3);
  EXPECT_LT(motion(world, 0).velocity.y, -0.4);
  EXPECT_EQ(motion(world, 1).velocity, glm::dvec3(0.0));
}

TEST(StiffBody, IsThrownBackByASolid) {
  Scene scene = lone_body(gas_ball(stiffness), {0, -1, 0});
  scene.bodies[0].position = {0, 0.6, 0};
  set_solid(scene, {Ground{}});
  World world(scene, explicit_steps);
  run(world, 30);
  EXPECT_GT(motion(world, 0).velocity.y, -0.1);
}

TEST(StiffBody, PassesItsMomentumOn) {
  for (const ContactSurfaceInfo& surface : contact_surfaces) {
    Scene scene = lone_body(gas_ball(stiffness), {2, 0, 0});
    scene.contact_surface = surface.value;
    add_body(scene, {1.3, 0, 0}, glm::dvec3(0.0));
    World world(scene, explicit_steps);
    run(world, 30);
    const double first = motion(world, 0).velocity.x, second = motion(world, 1).velocity.x;
    EXPECT_GT(second, 0.5);
    EXPECT_NEAR(first + second, 2, 1e-3);
  }
}

TEST(StiffBody, FollowsAHand) {
  World world(lone_body(gas_ball(stiffness)), explicit_steps);
  world.grab(Grab{.body = 0, .target = {0, 2, 0}});
  run(world, 6);
  EXPECT_GT(motion(world, 0).velocity.y, 1);
}

/// Its neighbour in the lanes meets a solid, or does not.
TEST(StiffBody, FliesTheSameWhateverItsNeighboursTouch) {
  Scene scene = lone_body(gas_ball(stiffness), {1, 0, 0});
  scene.contact_surface = ContactSurface::surfaces;
  set_solid(scene, {SolidSphere{.centre = {0, 5, 0}, .radius = 1}});
  add_body(scene, {0, 3.4, 0}, {0, 1, 0});
  World hit(scene, explicit_steps);
  scene.bodies[1].velocity = {0, -1, 0};
  World miss(scene, explicit_steps);
  for (World* world : {&hit, &miss}) run(*world, 20);
  EXPECT_LT(motion(hit, 1).velocity.y, 0.9) << "it hits";
  for (Index i = 0; i < hit.bodies().size(0); ++i) {
    const Particle a = hit.particle(0, i), b = miss.particle(0, i);
    ASSERT_TRUE(a.position == b.position && a.velocity == b.velocity) << i;
  }
}

}  // namespace THIS_FILE
}  // namespace softbody::test
