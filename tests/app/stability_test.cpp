// What the watch makes of the guard's alarms, and the step light.

#include <gtest/gtest.h>

#include "app/session/session.h"
#include "app/ui/status.h"
#include "tests/app/scenes.h"

namespace app {
namespace {

/// A world that is watched for ten frames, and the change that makes it explode in the next one.
struct Watched {
  softbody::World world = [] {
    softbody::Scene scene = touching_pair();
    scene.materials[0].structural.stiffness = 1e5;
    return softbody::World(scene, {});
  }();
  StabilityWatch watch;

  Watched() {
    for (int i = 0; i < 10; ++i) step();
  }
  void step() {
    watch.before_step(world);
    world.step();
    watch.after_step(world, true);
  }
  void explode() {
    ASSERT_FALSE(watch.alarm());
    ASSERT_LT(softbody::measure(world).max_speed, 5);
    world.set_integrator("semi-implicit-euler", 2);
    watch.intervened();
    step();
    ASSERT_GT(softbody::measure(world).max_speed, 10) << "it does not explode: the test looks at nothing";
    step();
    ASSERT_TRUE(watch.alarm());
  }
};

TEST(StabilityWatch, GoesBackBeforeAChangeThatBlewUpInItsFirstStep) {
  Watched w;
  w.explode();
  EXPECT_EQ(w.watch.last_good_frame(), 10);
}

TEST(StabilityWatch, KnowsNoGoodFrameThatIsStillToCome) {
  Watched w;
  w.world.restore(w.watch.past().snapshots().front());
  w.watch.went_back(w.world);
  const int now = w.world.frame();
  w.explode();
  EXPECT_EQ(w.watch.last_good_frame(), now);
}

TEST(StabilityWatch, WatchesAgainOnceTheWorldWasGoodForAWhile) {
  Watched w;
  w.explode();
  w.watch.dismiss_alarm();
  const int bad = w.world.frame();
  w.world.restore(w.watch.past().snapshots().front());  // bodies in order again: an exploded world would take minutes
  w.world.set_integrator(softbody::default_integrator, {});
  w.watch.intervened();
  const int again = bad + 2 * static_cast<int>(Guard::memory);
  while (w.world.frame() < again) {
    w.step();
    ASSERT_FALSE(w.watch.alarm()) << "of the same explosion, in frame " << w.world.frame();
  }
  EXPECT_GT(w.watch.past().snapshots().back().frame, bad);
  EXPECT_GT(w.watch.last_good_frame(), bad);
  w.world.set_integrator("semi-implicit-euler", 2);
  w.watch.intervened();
  while (!w.watch.alarm() && w.world.frame() < again + 10) w.step();
  EXPECT_TRUE(w.watch.alarm()) << "of another explosion";
}

TEST(StepLight, IsGreenAmberAndRed) {
  EXPECT_STREQ(status_light(StepMargin{}).name, "Green");
  EXPECT_STREQ(status_light(StepMargin{10, 10, 0.1, 0.1}).name, "Green");
  EXPECT_STREQ(status_light(StepMargin{9, 10, 0.1, 0.1}).name, "Amber");
  EXPECT_STREQ(status_light(StepMargin{8, 10, 0.1, 0.1}).name, "Amber");
  EXPECT_STREQ(status_light(StepMargin{7, 10, 0.1, 0.1}).name, "Red");
  EXPECT_STREQ(status_light(StepMargin{4000, 9000, 1e-6, 1e-6, StepMargin::Bound::stable, 0.4}).name, "Amber");
}

TEST(StepLight, KnowsHowMuchOfAFrameWasSimulated) {
  softbody::World world(touching_pair(), {.integrator = "semi-implicit-euler"});
  StabilityWatch watch;
  const auto step = [&] {
    watch.before_step(world);
    world.step();
    watch.after_step(world, false);
  };
  step();
  EXPECT_EQ(watch.margin().share, 1);
  std::vector<softbody::Particle> particles;
  for (softbody::Index i = 0; i < world.prototype(0).mesh.vertices.size(); ++i)
    particles.push_back(world.dynamics().particle(0, i));
  particles[0].velocity.y += 1e6;
  world.set_particles(0, particles);
  step();
  EXPECT_GT(watch.margin().share, 0);
  EXPECT_LT(watch.margin().share, 1);
  EXPECT_NEAR(watch.margin().substep * watch.margin().taken, watch.margin().share * world.frame_time(), 1e-12);
}

TEST(StepLight, SaysWhatTheBoundOfEachIntegratorMeans) {
  using Bound = StepMargin::Bound;
  EXPECT_STREQ(status_light(StepMargin{1, 10, 0.1, 0.01, Bound::unconditional}).name, "Amber");
  EXPECT_STREQ(status_light(StepMargin{10, 10, 0.1, 0.1, Bound::unconditional}).name, "Green");
  EXPECT_STREQ(status_light(StepMargin{10, 10, 0.1, 0.1, Bound::by_damping}).name, "Amber");
  EXPECT_STREQ(status_light(StepMargin{7, 10, 0.1, 0.1, Bound::by_damping}).name, "Red");
  for (const softbody::Integrator& integrator : softbody::integrators()) {
    softbody::World world(touching_pair(), {.integrator = std::string(integrator.key), .substeps = 1});
    StabilityWatch watch;
    watch.before_step(world);
    world.step();
    watch.after_step(world, true);
    const std::string_view used = world.dynamics().used_integrator().key;
    const Bound expected = used == "implicit" || used == "xpbd" ? Bound::unconditional
                           : used == "explicit-euler"           ? Bound::by_damping
                                                                : Bound::stable;
    EXPECT_EQ(watch.margin().kind, expected) << integrator.key;
  }
}

TEST(StepLight, ComparesTheStepWithTheBound) {
  for (const std::optional<int> substeps : {std::optional<int>(), std::optional(1)}) {
    softbody::World world(touching_pair(), {.integrator = "semi-implicit-euler", .substeps = substeps});
    const int needed = world.dynamics().substeps(world.frame_time());
    ASSERT_GT(needed, 1);
    StabilityWatch watch;
    watch.before_step(world);
    world.step();
    watch.after_step(world, true);
    EXPECT_GE(watch.margin().taken, substeps.value_or(needed));
    EXPECT_STREQ(status_light(watch.margin()).name, substeps ? "Red" : "Green");
    EXPECT_DOUBLE_EQ(watch.margin().substep, world.frame_time() / watch.margin().taken);
    EXPECT_EQ(watch.history().total.size(), 1u);
  }
}

TEST(StepLight, HasNothingToJudgeWhileAllSleep) {
  softbody::Scene scene = touching_pair();
  scene.sleep = {.speed = 1e3, .frames = 1};
  softbody::World world(scene, {});
  world.step();
  ASSERT_TRUE(world.all_at_rest());
  StabilityWatch watch;
  watch.before_step(world);
  world.step();
  watch.after_step(world, true);
  EXPECT_EQ(watch.margin().taken, 0);
  EXPECT_EQ(watch.margin().needed, 0);
}

}  // namespace
}  // namespace app
