// What swings undamped keeps its energy, however often the bound of a substep changes with its shape.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <string>
#include <utility>

#include "softbody/world/snapshot.h"
#include "tests/softbody/helpers.h"
#include "tests/support/change.h"

namespace softbody::test {
namespace THIS_FILE {

/// In balance at a pressure a little above that around it, and nearly undamped.
Material swinging_ball(double stiffness, double damping_ratio) {
  Material m = gas_ball();
  m.set(StructuralSprings::keys, {stiffness, damping_ratio});
  m.set(BendSprings::keys, {50, damping_ratio});
  m[GasPressure::inside] = 113e3;
  m[GasPressure::outside] = 101'325;
  m[Material::start_in_equilibrium] = true;
  return m;
}

class Swing : public testing::TestWithParam<double> {};  // damping ratio

/// Set going by another gas, down to none and up to almost twice as much.
TEST_P(Swing, GainsNoEnergyInSubstepsThatTheWorldChooses) {
  for (const std::string integrator : {"auto", "imex-euler"})
    for (const double stiffness : {200.0, 2e4})
      for (const double pressure : {0.0, 5e4, 9e4, 116e3, 13e4, 15e4, 2e5}) {
        Material m = swinging_ball(stiffness, GetParam());
        World world(lone_body(m), {.integrator = {integrator}});
        run(world, 5);
        m[GasPressure::inside] = pressure;
        change(world, [&](Scene& s) { s.materials[0] = m; });
        run(world, 3);  // the sudden force may bring the first substep's work besides
        const auto energy = [&] {
          const BodyMeasures b = measure_bodies(world)[0];
          return std::pair(b.conserved(ledger(world).staggering), b.energy.kinetic);
        };
        double start = energy().first, motion = 0;
        int most = world.last_step().substeps;
        for (int frame = 0; frame < 120; ++frame) {
          world.step();
          const auto [total, kinetic] = energy();
          motion = std::max(motion, kinetic);
          // A swing that grows stiffer may get shorter steps, which conserve another energy, but only once.
          if (world.last_step().substeps > most) start = std::max(start, total), most = world.last_step().substeps;
          const double rounding = 1e-7 * std::abs(start);  // of positions, which hardly move in the smallest swing
          ASSERT_LE(total, start + 0.1 * motion + rounding)
              << integrator << ", " << stiffness << " N/m, " << pressure << " Pa, frame " << frame;
        }
      }
}

INSTANTIATE_TEST_SUITE_P(Damping, Swing, testing::Values(0.0, 0.005, 0.02));

/// A small swing, in which forces are all but linear.
TEST(StaggeredSteps, ConserveTheEnergyOfTheirStaggering) {
  Material m = spring_ball();
  m[StructuralSprings::damping_ratio] = m[BendSprings::damping_ratio] = 0;
  const Scene scene = lone_body(m);
  World trial(scene, {.integrator = {"semi-implicit-euler"}});
  trial.step();
  const int least = trial.last_step().needed;
  World world(scene, {.integrator = {"semi-implicit-euler", least}});
  place(world, {1.001, 1, 0.999});
  double motion = 0, lowest[2]{1e300, 1e300}, highest[2]{-1e300, -1e300};
  for (int frame = 0; frame < 120; ++frame) {
    world.step();
    const BodyMeasures b = measure(world, 0);
    motion = std::max(motion, b.energy.kinetic);
    for (const int staggered : {0, 1}) {
      const double energy = b.conserved(staggered * world.last_step().last_substep);
      lowest[staggered] = std::min(lowest[staggered], energy);
      highest[staggered] = std::max(highest[staggered], energy);
    }
  }
  EXPECT_GT(highest[0] - lowest[0], 0.1 * motion) << "the plain one swings";
  EXPECT_LT(highest[1] - lowest[1], 0.01 * motion);
}

/// How far the second moments of a body's particles about their middle are from a ball's.
double out_of_round(const std::vector<Particle>& all) {
  glm::dvec3 middle(0.0);
  for (const Particle& p : all) middle += p.position / double(all.size());
  glm::dmat3 moments(0.0);
  for (const Particle& p : all) moments += glm::outerProduct(p.position - middle, p.position - middle);
  const double third = (moments[0][0] + moments[1][1] + moments[2][2]) / 3;
  double square = 0;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 off = moments[i] / third - glm::dmat3(1.0)[i];
    square += glm::dot(off, off);
  }
  return std::sqrt(square);
}

/// A ball in the frame in which it begins to fly apart by its gas, with hundreds of m/s.
World bursting(std::string integrator) {
  Material m = gas_ball(1000);
  m[GasPressure::inside] *= 100, m[GasPressure::outside] = 0;
  m[Material::start_in_equilibrium] = false;
  World world(lone_body(m), {.frame_time = 1.0 / 240, .integrator = {std::move(integrator)}});
  world.step();
  return world;
}

/// It comes together again.
TEST(ImplicitSteps, LeaveABurstRound) {
  World world = bursting("semi-implicit-euler");
  world.set_integrator({"implicit"});
  int most = 0;
  for (int frame = 0; frame < 60; ++frame) {
    world.step();
    most = std::max(most, world.last_step().substeps);
    ASSERT_LT(out_of_round(particles_of(world)), 1e-3) << frame;
  }
  EXPECT_GT(most, 4);
  EXPECT_LE(most, 16);
  run(world, 420);
  EXPECT_EQ(world.last_step().substeps, 1) << "hardly deforming any more";
}

/// Explicit substeps, more than one implicit step is worth, are fewer than all that it would take.
TEST(ImplicitSteps, CountWhereTheIntegratorIsChosen) {
  World world = bursting("auto");
  world.step();
  EXPECT_FALSE(world.last_step().integrator->implicit);
  EXPECT_GT(world.last_step().substeps, 150);
}

/// Squeezed for a frame and put back: nothing but memory asks for more substeps than before.
class HysteresisOfSubsteps : public testing::Test {
 protected:
  void squeeze() {
    const std::vector<Particle> before = particles_of(world);
    place(world, {0.3, 0.3, 0.3});
    world.step();
    world.set_particles(0, before);
    world.step();
    squeezed = world.last_step().substeps;
  }

  World world{lone_body(swinging_ball(200, 0.1)), {.integrator = {"semi-implicit-euler"}}};
  int squeezed = 0;  // substeps of the frame after
};

TEST_F(HysteresisOfSubsteps, KeepsTheRateForHalfASecondToOne) {
  run(world, 5);
  const int own = world.last_step().substeps;
  squeeze();
  ASSERT_GT(squeezed, 2 * own);
  for (int frame = 0; frame < 28; ++frame) {
    world.step();
    ASSERT_EQ(world.last_step().substeps, squeezed) << frame;
  }
  run(world, 32);
  EXPECT_EQ(world.last_step().substeps, own);
}

TEST_F(HysteresisOfSubsteps, IsRestoredWithASnapshot) {
  run(world, 5);
  squeeze();
  const Snapshot then = world.snapshot();
  run(world, 60);
  const std::uint64_t hash = world.state_hash();
  const int later = world.last_step().substeps;
  world.restore(then);
  run(world, 10);
  EXPECT_EQ(world.last_step().substeps, squeezed);
  run(world, 50);
  EXPECT_EQ(world.last_step().substeps, later);
  EXPECT_EQ(world.state_hash(), hash);
}

TEST_F(HysteresisOfSubsteps, EndsWhileAllBodiesSleep) {
  Scene scene = world.scene();
  scene.sleep = {.speed = 1e6, .frames = 2};
  World sleeper(scene, {.integrator = {"semi-implicit-euler"}});
  const std::vector<Particle> before = particles_of(sleeper);
  sleeper.step();
  const int own = sleeper.last_step().substeps;
  place(sleeper, {0.3, 0.3, 0.3});
  sleeper.step();
  ASSERT_GT(sleeper.last_step().substeps, 2 * own);
  run(sleeper, 62);
  ASSERT_TRUE(sleeper.all_at_rest());
  sleeper.set_particles(0, before);
  sleeper.step();
  EXPECT_EQ(sleeper.last_step().substeps, own);
}

/// So that a heap gets steps of one length, although its contacts come and go.
TEST_F(HysteresisOfSubsteps, CountsContacts) {
  Scene scene = lone_body(spring_ball());
  scene.materials[0][contact::stiffness] = 1e4;
  add_body(scene, {0, 1.02, 0}, glm::dvec3(0.0));
  World pair(scene, {.integrator = {"semi-implicit-euler"}});
  pair.step();
  const int touching = pair.last_step().substeps;
  std::vector<Particle> apart = particles_of(pair, 1);
  for (Particle& p : apart) p.position.y += 1;
  pair.set_particles(1, apart);
  run(pair, 2);  // the first still goes by the contacts that were found before
  EXPECT_EQ(pair.last_step().substeps, touching);
  EXPECT_LT(pair.last_step().needed, touching / 2);
  run(pair, 60);
  EXPECT_LT(pair.last_step().substeps, touching / 2);
}

/// A body that no number of substeps carries must not have its next frames cut short too; nor one that has too many
/// particles to be moved by implicit steps instead.
TEST_F(HysteresisOfSubsteps, IsLimitedToTheSubstepsOfAFrame) {
  Scene large = world.scene();
  large.bodies[0].mesh.subdivisions = 4;
  World automatic(large, {.integrator = {"auto"}});
  for (World* w : {&world, &automatic}) {
    run(*w, 5);
    const std::vector<Particle> before = particles_of(*w);
    std::vector<Particle> fast = before;
    fast[0].velocity = {1e6, 0, 0};
    w->set_particles(0, fast);
    w->step();
    ASSERT_FALSE(w->last_step().integrator->implicit);
    ASSERT_LT(w->last_step().seconds, w->frame_time());
    w->set_particles(0, before);
    w->step();
    EXPECT_EQ(w->last_step().seconds, w->frame_time());
  }
}

/// Else a body that swings would be moved in another way with every swing.
TEST_F(HysteresisOfSubsteps, CountsWhenTheIntegratorIsChosen) {
  world = World(lone_body(swinging_ball(3000, 0.1)), {.integrator = {"auto"}});
  const auto chosen = [&] { return world.last_step().integrator->key; };
  run(world, 5);
  ASSERT_EQ(chosen(), "semi-implicit-euler");
  squeeze();
  EXPECT_EQ(chosen(), "implicit") << "explicit substeps would be as many as when it was squeezed";
  world.set_integrator({"auto", 100});
  world.step();
  EXPECT_EQ(chosen(), "semi-implicit-euler") << "fixed ones are not";
  world.set_integrator({"auto"});
  run(world, 60);
  EXPECT_EQ(chosen(), "semi-implicit-euler");
}

}  // namespace THIS_FILE
}  // namespace softbody::test
