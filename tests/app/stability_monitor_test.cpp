// What the stability monitor does with blow-ups, and the step light.

#include <gtest/gtest.h>

#include "app/session/session.h"
#include "app/ui/views/status.h"
#include "softbody/forces/springs.h"
#include "softbody/model/body_model.h"
#include "tests/app/scenes.h"

namespace app {
namespace THIS_FILE {

/// A world that is monitored for ten frames, and a change that makes it blow up in the next one.
struct Monitored {
  softbody::World world = [] {
    softbody::Scene scene = touching_pair();
    scene.materials[0][softbody::StructuralSprings::stiffness] = 1e5;
    return softbody::World(scene, {});
  }();
  session::StabilityMonitor monitor;

  Monitored() {
    for (int i = 0; i < 10; ++i) step();
  }
  void step() {
    monitor.before_step(world);
    world.step();
    monitor.after_step(world, true);
  }
  void blow_up() {
    ASSERT_FALSE(monitor.blow_up());
    ASSERT_LT(softbody::measure(world).max_speed, 5);
    world.set_integrator({"semi-implicit-euler", 2});
    step();
    ASSERT_GT(softbody::measure(world).max_speed, 10) << "it does not blow up, so the test is void";
    step();
    ASSERT_TRUE(monitor.blow_up());
  }
};

TEST(StabilityMonitor, OffersTheFrameBeforeAChangeThatBlewUpAtOnce) {
  Monitored w;
  w.blow_up();
  EXPECT_EQ(w.monitor.last_good_frame(), 10);
}

TEST(StabilityMonitor, OffersNoGoodFrameOfTheFuture) {
  Monitored w;
  w.world.restore(w.monitor.past().snapshots().front());
  w.monitor.went_back(w.world);
  const int now = w.world.frame();
  w.blow_up();
  EXPECT_EQ(w.monitor.last_good_frame(), now);
}

TEST(StabilityMonitor, ReportsASecondBlowUpAfterARecovery) {
  Monitored w;
  w.blow_up();
  w.monitor.dismiss_blow_up();
  const int bad_frame = w.world.frame();
  w.world.restore(w.monitor.past().snapshots().front());  // a world that has blown up would take minutes
  w.world.set_integrator({});
  const int again = bad_frame + 2 * static_cast<int>(session::StabilityMonitor::recovery);
  while (w.world.frame() < again) {
    w.step();
    ASSERT_FALSE(w.monitor.blow_up()) << "of the same blow-up, in frame " << w.world.frame();
  }
  EXPECT_GT(w.monitor.past().snapshots().back().frame, bad_frame);
  EXPECT_GT(w.monitor.last_good_frame(), bad_frame);
  w.world.set_integrator({"semi-implicit-euler", 2});
  while (!w.monitor.blow_up() && w.world.frame() < again + 10) w.step();
  EXPECT_TRUE(w.monitor.blow_up()) << "of another blow-up";
}

TEST(StabilityMonitor, KeepsALargeWorldInTheFramesInWhichItWasMeasured) {
  softbody::Scene scene = touching_pair();
  scene.bodies[0].mesh.subdivisions = 5;  // 10,242 vertices
  softbody::World world(scene, {});
  session::StabilityMonitor monitor;
  for (int i = 0; i < 11; ++i) {
    monitor.before_step(world);
    world.step();
    monitor.after_step(world, true);
  }
  EXPECT_EQ(monitor.history().total.size(), 5u);
  EXPECT_EQ(monitor.last_good_frame(), 10);
  for (const softbody::Snapshot& kept : monitor.past().snapshots()) EXPECT_EQ(kept.frame % 2, 0);
}

TEST(StepLight, IsGreenAmberAndRed) {
  EXPECT_STREQ(ui::status_light(session::StepMargin{}).name, "Green");
  EXPECT_STREQ(ui::status_light(session::StepMargin{10, 10, 0.1, 0.1, 0.2}).name, "Green");
  EXPECT_STREQ(ui::status_light(session::StepMargin{9, 10, 0.1, 0.1, 0.2}).name, "Amber");
  EXPECT_STREQ(ui::status_light(session::StepMargin{8, 10, 0.1, 0.1, 0.2}).name, "Amber");
  EXPECT_STREQ(ui::status_light(session::StepMargin{8, 10, 0.1, 0.1, 0.1}).name, "Red");
  EXPECT_STREQ(ui::status_light(session::StepMargin{7, 10, 0.1, 0.1, 0.2}).name, "Red");
  EXPECT_STREQ(
      ui::status_light(session::StepMargin{4000, 9000, 1e-6, 1e-6, 0.2, session::StepMargin::Bound::stable, 0.4}).name,
      "Amber");
}

TEST(StepMargin, HasTheSimulatedShareOfAFrame) {
  softbody::World world(touching_pair(), {.integrator = {"semi-implicit-euler"}});
  session::StabilityMonitor monitor;
  const auto step = [&] {
    monitor.before_step(world);
    world.step();
    monitor.after_step(world, false);
  };
  step();
  EXPECT_EQ(monitor.margin().share, 1);
  std::vector<softbody::Particle> particles;
  for (softbody::Index i = 0; i < world.model(0).mesh.vertices.size(); ++i) particles.push_back(world.particle(0, i));
  particles[0].velocity.y += 1e6;
  world.set_particles(0, particles);
  step();
  EXPECT_GT(monitor.margin().share, 0);
  EXPECT_LT(monitor.margin().share, 1);
  EXPECT_NEAR(monitor.margin().substep * monitor.margin().taken, monitor.margin().share * world.frame_time(), 1e-12);
}

TEST(StepLight, DependsOnTheKindOfBound) {
  using Bound = session::StepMargin::Bound;
  EXPECT_STREQ(ui::status_light(session::StepMargin{1, 10, 0.1, 0.01, 0.2, Bound::unconditional}).name, "Amber");
  EXPECT_STREQ(ui::status_light(session::StepMargin{10, 10, 0.1, 0.1, 0.2, Bound::unconditional}).name, "Green");
  EXPECT_STREQ(ui::status_light(session::StepMargin{10, 10, 0.1, 0.1, 0.2, Bound::by_damping}).name, "Amber");
  EXPECT_STREQ(ui::status_light(session::StepMargin{7, 10, 0.1, 0.1, 0.2, Bound::by_damping}).name, "Red");
  for (const softbody::Integrator& integrator : softbody::integrators()) {
    softbody::World world(touching_pair(), {.integrator = {std::string(integrator.key), 1}});
    session::StabilityMonitor monitor;
    monitor.before_step(world);
    world.step();
    monitor.after_step(world, true);
    const std::string_view used = world.last_step().integrator->key;
    const Bound expected = used == "implicit" || used == "xpbd" ? Bound::unconditional
                           : used == "explicit-euler"           ? Bound::by_damping
                                                                : Bound::stable;
    EXPECT_EQ(monitor.margin().kind, expected) << integrator.key;
  }
}

TEST(StepLight, ComparesTheStepWithTheBound) {
  for (const std::optional<int> substeps : {std::optional<int>(), std::optional(1)}) {
    softbody::World world(touching_pair(), {.integrator = {"semi-implicit-euler", substeps}});
    session::StabilityMonitor monitor;
    monitor.before_step(world);
    world.step();
    monitor.after_step(world, true);
    const int needed = world.last_step().needed;
    ASSERT_GT(needed, 1);
    EXPECT_EQ(monitor.margin().needed, needed);
    EXPECT_GE(monitor.margin().taken, substeps.value_or(needed));
    EXPECT_STREQ(ui::status_light(monitor.margin()).name, substeps ? "Red" : "Green");
    EXPECT_DOUBLE_EQ(monitor.margin().substep, world.frame_time() / monitor.margin().taken);
    EXPECT_EQ(monitor.history().total.size(), 1u);
  }
}

TEST(StepMargin, IsZeroWhileAllBodiesSleep) {
  softbody::Scene scene = touching_pair();
  scene.sleep = {.speed = 1e3, .frames = 1};
  softbody::World world(scene, {});
  world.step();
  ASSERT_TRUE(world.all_at_rest());
  session::StabilityMonitor monitor;
  monitor.before_step(world);
  world.step();
  monitor.after_step(world, true);
  EXPECT_EQ(monitor.margin().taken, 0);
  EXPECT_EQ(monitor.margin().needed, 0);
}

}  // namespace THIS_FILE
}  // namespace app
