// What swings undamped keeps its energy, however often the bound of a substep changes with its shape.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

/// Set going by another gas, down to none and up to almost twice as much.
TEST(Swing, GainsNoEnergyInSubstepsThatTheWorldChooses) {
  for (const std::string integrator : {"auto", "imex-euler"})
    for (const double stiffness : {200.0, 2e4})
      for (const double pressure : {0.0, 116e3, 2e5}) {
        Material m = swinging_ball(stiffness, 0);
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

/// Squeezed for a frame and put back: nothing but memory asks for more substeps than before.
TEST(Snapshot, RestoresTheRateThatSubstepsKeep) {
  World world(lone_body(swinging_ball(200, 0.1)), {.integrator = {"semi-implicit-euler"}});
  run(world, 5);
  const int own = world.last_step().substeps;
  const std::vector<Particle> before = particles_of(world);
  place(world, {0.3, 0.3, 0.3});
  world.step();
  world.set_particles(0, before);
  world.step();
  const int squeezed = world.last_step().substeps;
  ASSERT_GT(squeezed, 2 * own);
  const Snapshot then = world.snapshot();
  run(world, 60);
  const std::uint64_t hash = world.state_hash();
  EXPECT_EQ(world.last_step().substeps, own);
  world.restore(then);
  run(world, 10);
  EXPECT_EQ(world.last_step().substeps, squeezed);
  run(world, 50);
  EXPECT_EQ(world.state_hash(), hash);
}

}  // namespace THIS_FILE
}  // namespace softbody::test
