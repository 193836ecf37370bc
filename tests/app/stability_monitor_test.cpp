// What the stability monitor does with blow-ups, and the step light.

#include <gtest/gtest.h>

#include "app/session/session.h"
#include "app/ui/views/status.h"
#include "softbody/forces/springs.h"
#include "softbody/model/body_model.h"
#include "tests/app/scenes.h"

namespace app {
namespace THIS_FILE {

/// A world that is monitored.
struct Monitored {
  softbody::World world;
  session::StabilityMonitor monitor;

  Monitored(const softbody::Scene& scene, const softbody::IntegratorChoice& integrator)
      : world(scene, {.integrator = integrator}) {}
  void step(int frames = 1) {
    for (int i = 0; i < frames; ++i) {
      monitor.before_step(world);
      world.step();
      monitor.after_step(world, true);
    }
  }
  const session::StepMargin& margin() const { return monitor.margin(); }
  const char* light() const { return ui::status_light(margin()).name; }
};

/// A world after ten frames, and a change that makes it blow up in the next one.
struct Stiff : Monitored {
  Stiff() : Monitored(scene(), {}) { step(10); }
  static softbody::Scene scene() {
    softbody::Scene scene = touching_pair();
    scene.materials[0][softbody::StructuralSprings::stiffness] = 1e5;
    return scene;
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
  Stiff w;
  w.blow_up();
  EXPECT_EQ(w.monitor.last_good_frame(), 10);
}

TEST(StabilityMonitor, OffersNoGoodFrameOfTheFuture) {
  Stiff w;
  w.world.restore(w.monitor.past().snapshots().front());
  w.monitor.went_back(w.world);
  const int now = w.world.frame();
  w.blow_up();
  EXPECT_EQ(w.monitor.last_good_frame(), now);
}

TEST(StabilityMonitor, ReportsASecondBlowUpAfterARecovery) {
  Stiff w;
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
  Monitored w(scene, {});
  w.step(11);
  EXPECT_EQ(w.monitor.history().front().size(), 5u);
  EXPECT_EQ(w.monitor.last_good_frame(), 10);
  for (const softbody::Snapshot& kept : w.monitor.past().snapshots()) EXPECT_EQ(kept.frame % 2, 0);
}

TEST(StepLight, ComparesTheStepsTakenWithTheBoundAndItsReserve) {
  using session::StepMargin;
  using Bound = StepMargin::Bound;
  struct Row {
    StepMargin margin;
    std::string_view light;
  };
  for (const auto& [margin, light] :
       {Row{StepMargin{}, "Green"}, Row{StepMargin{10, 10, 0.1, 0.1, 0.2}, "Green"},
        Row{StepMargin{9, 10, 0.1, 0.1, 0.2}, "Amber"}, Row{StepMargin{8, 10, 0.1, 0.1, 0.2}, "Amber"},
        Row{StepMargin{8, 10, 0.1, 0.1, 0.1}, "Red"}, Row{StepMargin{7, 10, 0.1, 0.1, 0.2}, "Red"},
        Row{StepMargin{4000, 9000, 1e-6, 1e-6, 0.2, Bound::stable, 0.4}, "Amber"},
        Row{StepMargin{1, 10, 0.1, 0.01, 0.2, Bound::unconditional}, "Amber"},
        Row{StepMargin{10, 10, 0.1, 0.1, 0.2, Bound::unconditional}, "Green"},
        Row{StepMargin{10, 10, 0.1, 0.1, 0.2, Bound::by_damping}, "Amber"},
        Row{StepMargin{7, 10, 0.1, 0.1, 0.2, Bound::by_damping}, "Red"}})
    EXPECT_EQ(ui::status_light(margin).name, light)
        << margin.taken << " of " << margin.needed << ", " << margin.reserve;
}

TEST(StepMargin, HasTheSimulatedShareOfAFrame) {
  Monitored w(touching_pair(), {"semi-implicit-euler"});
  w.step();
  EXPECT_EQ(w.margin().share, 1);
  std::vector<softbody::Particle> particles;
  for (softbody::Index i = 0; i < w.world.model(0).mesh.vertices.size(); ++i)
    particles.push_back(w.world.particle(0, i));
  particles[0].velocity.y += 1e6;
  w.world.set_particles(0, particles);
  w.step();
  EXPECT_GT(w.margin().share, 0);
  EXPECT_LT(w.margin().share, 1);
  EXPECT_NEAR(w.margin().substep * w.margin().taken, w.margin().share * w.world.frame_time(), 1e-12);
}

TEST(StepMargin, HasTheKindOfBoundOfTheIntegrator) {
  using Bound = session::StepMargin::Bound;
  for (const softbody::Integrator& integrator : softbody::integrators()) {
    Monitored w(touching_pair(), {std::string(integrator.key), 1});
    w.step();
    const std::string_view used = w.world.last_step().integrator->key;
    const Bound expected = used == "implicit" || used == "xpbd" ? Bound::unconditional
                           : used == "explicit-euler"           ? Bound::by_damping
                                                                : Bound::stable;
    EXPECT_EQ(w.margin().kind, expected) << integrator.key;
  }
}

TEST(StepMargin, HasTheStepsTakenAndNeeded) {
  for (const std::optional<int> substeps : {std::optional<int>(), std::optional(1)}) {
    Monitored w(touching_pair(), {"semi-implicit-euler", substeps});
    w.step();
    const int needed = w.world.last_step().needed;
    ASSERT_GT(needed, 1);
    EXPECT_EQ(w.margin().needed, needed);
    EXPECT_GE(w.margin().taken, substeps.value_or(needed));
    EXPECT_STREQ(w.light(), substeps ? "Red" : "Green");
    EXPECT_DOUBLE_EQ(w.margin().substep, w.world.frame_time() / w.margin().taken);
    EXPECT_EQ(w.monitor.history().front().size(), 1u);
  }
}

TEST(StepMargin, IsZeroWhileAllBodiesSleep) {
  softbody::Scene scene = touching_pair();
  scene.sleep = {.speed = 1e3, .frames = 1};
  Monitored w(scene, {});
  w.step();
  ASSERT_TRUE(w.world.all_at_rest());
  w.step();
  EXPECT_EQ(w.margin().taken, 0);
  EXPECT_EQ(w.margin().needed, 0);
}

}  // namespace THIS_FILE
}  // namespace app
