// Every integrator of the table: order of convergence, conservation, stability at its bound, contacts.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

/// A ball that has been pulled longer along one axis and flies, turning.
Scene swinging_ball(double damping_ratio) {
  Material m = spring_ball();
  m.set(StructuralSprings::keys, {1000, damping_ratio});
  m.set(BendSprings::keys, {250, damping_ratio});
  Scene scene = lone_body(m, {1, 2, 0.5});
  scene.gravity = {0, -9.81, 0};
  return scene;
}

/// Its particles after some frames of 1/60 s with so many substeps each.
std::vector<glm::dvec3> flight(const Scene& scene, std::string_view integrator, int substeps, int frames) {
  World world(scene, {.integrator = {std::string(integrator), substeps}});
  run(world, frames);
  std::vector<glm::dvec3> list;
  for (Index i = 0; i < world.model(0).mesh.vertices.size(); ++i) list.push_back(world.particle(0, i).position);
  return list;
}

double rms(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += glm::dot(a[i] - b[i], a[i] - b[i]);
  return std::sqrt(sum / double(a.size()));
}

/// Substeps worth about as many of an explicit integrator's. Auto makes implicit steps of what is asked for.
int about(const Integrator& i, int substeps) {
  return std::max(1, substeps / (i.implicit || i.automatic ? 50 : i.substeps_per_step));
}

class Integrators : public testing::TestWithParam<Integrator> {};

TEST_P(Integrators, ConvergeWithTheirOrder) {
  const Integrator& i = GetParam();
  Scene scene = swinging_ball(0.02);
  scene.materials[0][GasPressure::inside] = 500;  // it breathes, for it does not start in equilibrium
  scene.materials[0][Material::start_in_equilibrium] = false;
  const auto reference = flight(scene, "rk4", 256, 6);
  // Coarse enough for the error to be far above a float's.
  const int coarse = i.order == 4 ? 6 : std::max(48 / i.substeps_per_step, 3);
  const double before = rms(flight(scene, i.key, coarse, 6), reference);
  const double after = rms(flight(scene, i.key, 2 * coarse, 6), reference);
  RecordProperty("before", std::to_string(before));
  EXPECT_GT(std::log2(before / after), i.order - 0.35) << before << " m, then " << after << " m";
}

TEST_P(Integrators, KeepLinearAndAngularMomentum) {
  Scene scene = swinging_ball(0.05);
  scene.gravity = {};
  scene.materials[0][GasPressure::inside] = 400;
  scene.materials[0][Material::start_in_equilibrium] = false;
  const Integrator& i = GetParam();
  World world(scene, {.integrator = {std::string(i.key), i.order == 1 ? about(i, 100) : i.implicit ? 2 : 20}});
  const Motion start = motion(world, 0);
  run(world, 60);
  const Motion end = motion(world, 0);
  // XPBD's corrections turn while it passes over the springs, and each goes through a displacement and back.
  const bool approximate = i.key == "xpbd";
  EXPECT_LT(glm::distance(end.velocity, start.velocity), (approximate ? 1e-4 : 1e-5) * glm::length(start.velocity));
  EXPECT_LT(glm::distance(end.spin_momentum, start.spin_momentum),
            (approximate ? 1e-3 : 1e-5) * glm::length(start.velocity));
}

TEST_P(Integrators, AreStableAtTheirBound) {
  for (const double zeta : {0.0, 0.02, 0.5, 3.0}) {
    World world(swinging_ball(zeta), {.frame_time = 1e-3, .integrator = {std::string(GetParam().key)}});
    const double start = measure(world).energy;
    run(world, 150);
    const Measures end = measure(world);
    ASSERT_TRUE(end.finite) << zeta;
    // Explicit Euler may gain where nothing damps, by a factor of e a second.
    EXPECT_LT(end.energy, start + 0.25 * (0.5 * 5.25 + 1)) << "damping ratio " << zeta;
  }
}

TEST_P(Integrators, LetNothingSinkIntoTheGround) {
  Scene scene = swinging_ball(0.3);
  scene.bodies[0].position = {0, 1, 0};
  set_solid(scene, {Ground{}});
  World world(scene, {.integrator = {std::string(GetParam().key), about(GetParam(), 100)}});
  for (int frame = 0; frame < 50; ++frame) {
    world.step();
    const Measures m = measure(world);
    ASSERT_TRUE(m.finite) << frame;
    ASSERT_LT(m.deepest_penetration, 1e-4) << frame;
    ASSERT_LT(m.max_speed, 12) << frame;
  }
}

INSTANTIATE_TEST_SUITE_P(Table, Integrators, testing::ValuesIn(integrators().begin(), integrators().end()),
                         [](const auto& i) {
                           std::string name(i.param.key);
                           std::erase(name, '-');
                           return name;
                         });

TEST(Integrator, CanBeChangedWhileItRuns) {
  World world(drop_scene(), {});
  run(world, 100);
  for (const Integrator& i : integrators()) {
    world.set_integrator({std::string(i.key), about(i, 60)});
    run(world, 3);
    EXPECT_EQ(world.integrator_choice().key, i.key);
    EXPECT_EQ(world.last_step().substeps, about(i, 60) * i.substeps_per_step) << i.key;
    EXPECT_TRUE(measure(world).finite) << i.key;
  }
  world.set_integrator({});
  world.step();
  EXPECT_FALSE(world.integrator_choice().substeps);
}

/// Modes across the springs have little damping for what tension and gas stiffen them.
TEST(Integrator, ExplicitEulerKeepsItsEnergyAtItsBound) {
  for (const double stiffness : {1e3, 1e5}) {
    Scene scene = swinging_ball(0.1);
    scene.materials[0][StructuralSprings::stiffness] = stiffness;
    scene.materials[0].set(BendSprings::keys, {stiffness / 4, 0.1});
    scene.materials[0][GasPressure::inside] = 1.6 * stiffness;
    scene.materials[0][GasPressure::outside] = 0;
    scene.materials[0][Material::start_in_equilibrium] = false;  // it breathes
    World world(scene, {.integrator = {"explicit-euler"}});
    const double start = measure(world).energy;
    for (int frame = 0; frame < 3; ++frame) {
      world.step();
      ASSERT_LT(measure(world).energy, start) << stiffness << " N/m, frame " << frame;
    }
  }
}

TEST(ExplicitEuler, CountsOnNoDampingButTheBodysOwn) {
  const World::Options options{.integrator = {"explicit-euler"}, .budget = {.least = 1e6}};
  Scene undamped = lone_body(gas_ball(100, 0));
  const auto needed = [&](const Scene& scene) {
    World world(scene, options);
    world.step();
    return world.last_step().needed;
  };
  constexpr int hopeless = 100'000;
  EXPECT_GT(needed(undamped), hopeless);
  add_body(undamped, {0, 1.02, 0}, {});
  EXPECT_GT(needed(undamped), hopeless) << "contacts damp, but only where they are";
}

TEST(Integrator, XpbdIsStableHoweverStiffTheGas) {
  for (const double pressure : {1e5, 1e6, 1e7}) {
    Material m = gas_ball();
    m[GasPressure::inside] = m[GasPressure::outside] = pressure;
    World world(lone_body(m), {.integrator = {"xpbd", 10}});
    place(world, glm::dvec3(0.95));
    for (int frame = 0; frame < 30; ++frame) {
      world.step();
      const Measures now = measure(world);
      ASSERT_TRUE(now.finite) << pressure << " Pa, frame " << frame;
      ASSERT_NEAR(now.volume_ratio_min, 1, 0.05) << pressure << " Pa, frame " << frame;
    }
  }
}

}  // namespace THIS_FILE
}  // namespace softbody::test
