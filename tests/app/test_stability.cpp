// The guard against figures made up for it, the past within its bound, and both in a session.

#include <gtest/gtest.h>

#include "app/demo/session.h"
#include "app/demo/status.h"
#include "tests/app/scenes.h"

namespace app {
namespace {

constexpr double tick = 1.0001 / 60;  // s, a little more than a frame

softbody::World pair_after(int frames) {
  softbody::World world(touching_pair(), {});
  for (int i = 0; i < frames; ++i) world.step();
  return world;
}

void run(Session& session, int frames) {
  for (int i = 0; i < frames; ++i) session.advance(tick);
}

TEST(Guard, NamesTheBodyThatIsNoLongerFinite) {
  const softbody::World world = pair_after(1);
  auto bodies = softbody::measure_bodies(world);
  Guard guard;
  EXPECT_FALSE(guard.look(world, bodies));
  bodies[1].finite = false;
  const auto alarm = guard.look(world, bodies);
  ASSERT_TRUE(alarm);
  EXPECT_EQ(alarm->body, 1u);
  EXPECT_EQ(alarm->frame, 1);
  EXPECT_NE(alarm->what.find("Body 1 is no longer finite"), std::string::npos) << alarm->what;
}

TEST(Guard, NamesTheBodyThatGainsEnergyFromNothing) {
  const softbody::World world = pair_after(1);
  auto bodies = softbody::measure_bodies(world);
  const double weight = 9.81 * world.prototype(0).radius;  // J: m g R of one body of 1 kg
  Guard guard;
  EXPECT_FALSE(guard.look(world, bodies));
  bodies[1].energy.elastic += 0.1 * weight;
  EXPECT_FALSE(guard.look(world, bodies)) << "contacts give that much back";
  bodies[1].energy.elastic += 0.3 * weight;
  const auto alarm = guard.look(world, bodies);
  ASSERT_TRUE(alarm);
  EXPECT_EQ(alarm->body, 1u);
  EXPECT_NE(alarm->what.find("energy"), std::string::npos) << alarm->what;
}

TEST(Guard, NamesTheBodyThatIsFasterThanAnythingThereCouldBe) {
  const softbody::World world = pair_after(1);
  auto bodies = softbody::measure_bodies(world);
  Guard guard;
  EXPECT_FALSE(guard.look(world, bodies));
  bodies[0].max_speed = 13;
  EXPECT_FALSE(guard.look(world, bodies)) << "a second's fall, and half as much";
  bodies[0].max_speed = 60;
  const auto alarm = guard.look(world, bodies);
  ASSERT_TRUE(alarm);
  EXPECT_EQ(alarm->body, 0u);
  EXPECT_NE(alarm->what.find("m/s"), std::string::npos) << alarm->what;
}

TEST(Guard, CountsAnewAfterAChange) {
  const softbody::World world = pair_after(1);
  auto bodies = softbody::measure_bodies(world);
  Guard guard;
  EXPECT_FALSE(guard.look(world, bodies));
  guard.restart();
  bodies[0].energy.elastic += 1000;
  EXPECT_FALSE(guard.look(world, bodies));
  EXPECT_FALSE(guard.look(world, bodies));
  bodies[0].energy.elastic += 1000;
  EXPECT_TRUE(guard.look(world, bodies));
}

/// Springs far too stiff for a single substep a frame.
TEST(Guard, CatchesEveryIntegratorThatExplodesBeforeItIsLost) {
  softbody::Scene scene = touching_pair();
  scene.materials[0].structural.stiffness = 1e5;
  for (const char* integrator : {"explicit-euler", "semi-implicit-euler", "velocity-verlet", "rk4"}) {
    softbody::World world(scene, {.integrator = integrator, .substeps = 1});
    Guard guard;
    std::optional<Alarm> alarm;
    while (!alarm && world.frame() < 60) {
      world.step();
      alarm = guard.look(world, softbody::measure_bodies(world));
    }
    EXPECT_TRUE(alarm) << integrator;
  }
}

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

TEST(StepLight, IsGreenAmberAndRed) {
  EXPECT_STREQ(light_of(StepMargin{}).name, "Green");
  EXPECT_STREQ(light_of(StepMargin{10, 10, 0.1, 0.1}).name, "Green");
  EXPECT_STREQ(light_of(StepMargin{9, 10, 0.1, 0.1}).name, "Amber");
  EXPECT_STREQ(light_of(StepMargin{8, 10, 0.1, 0.1}).name, "Amber");
  EXPECT_STREQ(light_of(StepMargin{7, 10, 0.1, 0.1}).name, "Red");
  EXPECT_STREQ(light_of(StepMargin{4000, 9000, 1e-6, 1e-6, StepMargin::Bound::stable, 0.4}).name, "Amber");
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
  EXPECT_STREQ(light_of(StepMargin{1, 10, 0.1, 0.01, Bound::unconditional}).name, "Amber");
  EXPECT_STREQ(light_of(StepMargin{10, 10, 0.1, 0.1, Bound::unconditional}).name, "Green");
  EXPECT_STREQ(light_of(StepMargin{10, 10, 0.1, 0.1, Bound::by_damping}).name, "Amber");
  EXPECT_STREQ(light_of(StepMargin{7, 10, 0.1, 0.1, Bound::by_damping}).name, "Red");
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
    EXPECT_STREQ(light_of(watch.margin()).name, substeps ? "Red" : "Green");
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

/// Everything that the shipped scenes do, with bodies that come and settings that change, is within reach.
TEST(Guard, IsSilentThroughAWholeSessionOfChanges) {
  for (const auto surface : {softbody::ContactSurface::vertices, softbody::ContactSurface::surfaces}) {
    Session session(touching_pair(), {}, 1);
    session.set_contact_surface(surface);
    for (int round = 0; round < 6; ++round) {
      run(session, 50);
      session.drop();
      run(session, 10);
      collide::Settings settings = session.world().collision();
      settings.tolerance = round % 2 ? 0.1f : 0.4f;
      session.set_collision(settings, true);
    }
    EXPECT_FALSE(session.stability().alarm()) << session.stability().alarm()->what;
    EXPECT_FALSE(session.paused);
  }
}

TEST(Rewind, KeepsWithinItsMemoryDenseLatelyAndSparseLongAgo) {
  softbody::World world(touching_pair(), {});
  const std::size_t one = world.snapshot().bytes();
  Rewind past(12 * one);
  for (int i = 0; i < 400; ++i) {
    past.keep(world);
    EXPECT_LE(past.bytes(), 12 * one);
    EXPECT_EQ(past.snapshots().back().frame, i);
    world.step();
  }
  const auto& list = past.snapshots();
  ASSERT_GE(list.size(), 8u);
  EXPECT_EQ(list.front().frame, 0) << "the start of it all stays";
  const auto gap = [&](std::size_t i) { return list[i].frame - list[i - 1].frame; };
  for (std::size_t i = 1; i + 1 < list.size(); ++i) EXPECT_GE(gap(i), Rewind::period);
  EXPECT_GE(list[list.size() - 2].frame, 400 - 3 * Rewind::period);
  EXPECT_GT(gap(1), 4 * gap(list.size() - 2));
  std::size_t sum = 0;
  for (const softbody::Snapshot& s : list) sum += s.bytes();
  EXPECT_EQ(past.bytes(), sum);
}

TEST(Rewind, KeepsOneSnapshotHoweverLargeItIs) {
  softbody::World world(touching_pair(), {});
  Rewind past(1);
  for (int i = 0; i < 12; ++i) {
    past.keep(world);
    EXPECT_EQ(past.snapshots().size(), 1u);
    EXPECT_EQ(past.snapshots()[0].frame, i);
    world.step();
  }
}

TEST(Rewind, ForgetsTheFutureThatDidNotCome) {
  softbody::World world(touching_pair(), {});
  Rewind past;
  for (int i = 0; i < 43; ++i) {
    past.keep(world);
    world.step();
  }
  EXPECT_EQ(past.snapshots()[past.at(21)].frame, 20);
  EXPECT_EQ(past.snapshots()[past.at(-1)].frame, 0);
  EXPECT_EQ(past.snapshots()[past.at(1000)].frame, 42);
  world.restore(past.snapshots()[past.at(21)]);
  past.keep(world);
  EXPECT_EQ(past.snapshots().back().frame, 20);
}

TEST(Session, GoesBackAndOnFromThereToTheBit) {
  Session session(touching_pair(), {}, 1);
  run(session, 63);
  const std::uint64_t there = session.world().state_hash();
  const std::uint64_t revision = session.revision();
  session.rewind_to(31);
  EXPECT_TRUE(session.paused);
  EXPECT_EQ(session.world().frame(), 30);
  EXPECT_GT(session.revision(), revision);
  EXPECT_EQ(session.before_last_step().y[0], session.world().positions().y[0]);
  session.rewind_to(63);
  EXPECT_EQ(session.world().frame(), 63) << "the present was kept";
  EXPECT_EQ(session.world().state_hash(), there);
  session.rewind_to(30);
  session.paused = false;
  run(session, 33);
  EXPECT_EQ(session.world().frame(), 63);
  EXPECT_EQ(session.world().state_hash(), there);
}

TEST(Session, ShowsWhatIsSoWhereItWentBackTo) {
  Session session(touching_pair(), {}, 1);
  run(session, 63);
  session.rewind_to(30);
  const softbody::Measures now = softbody::measure(session.world());
  const StabilityHistory& shown = session.stability().history();
  EXPECT_FLOAT_EQ(shown.kinetic.latest(), float(now.energies.kinetic));
  EXPECT_FLOAT_EQ(shown.gravity.latest(), float(now.energies.gravity));
  EXPECT_FLOAT_EQ(shown.speed.latest(), float(now.max_speed));
  for (const Ring* ring : {&shown.total, &session.history().contacts}) {
    ASSERT_GT(ring->size(), 0u);
    EXPECT_LE(ring->frame(ring->size() - 1), 30);
  }
  EXPECT_EQ(session.stability().margin().taken, 0);
  EXPECT_FALSE(session.world().all_at_rest()) << "so the light may not say that nothing moves";
}

TEST(Ring, ForgetsFromAFrameOn) {
  Ring ring;
  for (int frame = 0; frame < 300; ++frame) ring.push(frame, static_cast<float>(frame));
  ring.forget_from(250);
  EXPECT_EQ(ring.latest(), 249);
  EXPECT_EQ(ring.largest(), 249);
  EXPECT_EQ(ring.smallest(), 120);
  ring.push(250, -1);
  EXPECT_EQ(ring.smallest(), -1);
  EXPECT_EQ(ring.size(), 131u);
  ring.forget_from(0);
  EXPECT_EQ(ring.size(), 0u);
}

TEST(Session, GoesBackWithTheSettingsInUse) {
  Session session(touching_pair(), {}, 1);
  run(session, 20);
  session.drop();
  run(session, 20);
  session.set_method("grid-hash");
  session.set_contact_surface(softbody::ContactSurface::surfaces);
  collide::Settings settings = session.world().collision();
  settings.buckets = 77;
  session.set_collision(settings, false);
  session.rewind_to(10);
  EXPECT_EQ(session.world().bodies().count(), 2u);
  EXPECT_EQ(session.world().method().key, "grid-hash");
  EXPECT_EQ(session.world().collision().buckets, 77u);
  EXPECT_FALSE(session.world().uses_default_cell_size());
  EXPECT_EQ(session.world().scene().contact_surface, softbody::ContactSurface::surfaces);
}

TEST(Session, PausesWhenABodyExplodesAndOffersTheLastGoodFrame) {
  Session session(doomed_pair(), {}, 1);
  run(session, 40);
  ASSERT_TRUE(session.stability().alarm());
  EXPECT_TRUE(session.paused);
  EXPECT_EQ(session.stability().alarm()->body, 1u);
  const int bad = session.stability().alarm()->frame;
  EXPECT_EQ(session.world().frame(), bad);
  EXPECT_LT(session.stability().last_good_frame(), bad);
  session.rewind_to(session.stability().last_good_frame());
  EXPECT_FALSE(session.stability().alarm());
  EXPECT_TRUE(softbody::measure(session.world()).finite);
}

TEST(Session, GoesOnThroughAnExplosionWhenAskedTo) {
  Session session(doomed_pair(), {}, 1);
  session.guarded = false;
  run(session, 40);
  EXPECT_FALSE(session.stability().alarm());
  EXPECT_FALSE(session.paused);
  session.reset();
  session.guarded = true;
  run(session, 40);
  ASSERT_TRUE(session.stability().alarm());
  session.paused = false;
  const int bad = session.world().frame();
  run(session, 5);
  EXPECT_EQ(session.world().frame(), bad + 5) << "it stops once, not in every frame";
  EXPECT_LT(session.stability().past().snapshots().back().frame, bad) << "no bad frame is kept";
}

}  // namespace
}  // namespace app
