// Snapshots within their bound; blow-ups and going back in a session.

#include <gtest/gtest.h>

#include "app/session/session.h"
#include "tests/app/scenes.h"

namespace app {
namespace {

void run(Session& session, int frames) {
  for (int i = 0; i < frames; ++i) session.advance(tick);
}

TEST(Rewind, StaysWithinItsMemoryWithGapsThatGrowWithAge) {
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
  EXPECT_EQ(list.front().frame, 0) << "the first one stays";
  const auto gap = [&](std::size_t i) { return list[i].frame - list[i - 1].frame; };
  for (std::size_t i = 1; i + 1 < list.size(); ++i) EXPECT_GE(gap(i), Rewind::period);
  EXPECT_GE(list[list.size() - 2].frame, 400 - 3 * Rewind::period);
  EXPECT_GT(gap(1), 4 * gap(list.size() - 2));
  std::size_t sum = 0;
  for (const softbody::Snapshot& s : list) sum += s.bytes();
  EXPECT_EQ(past.bytes(), sum);
}

TEST(Rewind, KeepsOneSnapshotOfAnySize) {
  softbody::World world(touching_pair(), {});
  Rewind past(1);
  for (int i = 0; i < 12; ++i) {
    past.keep(world);
    EXPECT_EQ(past.snapshots().size(), 1u);
    EXPECT_EQ(past.snapshots()[0].frame, i);
    world.step();
  }
}

TEST(Rewind, ForgetsLaterSnapshotsAfterGoingBack) {
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

/// All that the shipped scenes do, with added bodies and changed settings, stays within the limits.
TEST(BlowUpMonitor, AcceptsAWholeSessionOfChanges) {
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
    EXPECT_FALSE(session.stability().blow_up()) << session.stability().blow_up()->what;
    EXPECT_FALSE(session.paused);
  }
}

TEST(Session, GoesBackAndContinuesToTheBit) {
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

TEST(Session, ShowsTheFiguresOfTheFrameItWentBackTo) {
  Session session(touching_pair(), {}, 1);
  run(session, 63);
  session.rewind_to(30);
  const softbody::Measures now = softbody::measure(session.world());
  const StabilityHistory& shown = session.stability().history();
  EXPECT_FLOAT_EQ(shown.kinetic.latest(), float(now.energies.kinetic));
  EXPECT_FLOAT_EQ(shown.gravity.latest(), float(now.energies.gravity));
  EXPECT_FLOAT_EQ(shown.speed.latest(), float(now.max_speed));
  for (const TimeSeries* series : {&shown.total, &session.history().contacts}) {
    ASSERT_GT(series->size(), 0u);
    EXPECT_LE(series->frame(series->size() - 1), 30);
  }
  EXPECT_EQ(session.stability().margin().taken, 0);
  EXPECT_FALSE(session.world().all_at_rest()) << "so the light must not say that nothing moves";
}

TEST(TimeSeries, ForgetsValuesFromAFrameOn) {
  TimeSeries series;
  for (int frame = 0; frame < 300; ++frame) series.push(frame, static_cast<float>(frame));
  series.forget_from(250);
  EXPECT_EQ(series.latest(), 249);
  EXPECT_EQ(series.max(), 249);
  EXPECT_EQ(series.min(), 120);
  series.push(250, -1);
  EXPECT_EQ(series.min(), -1);
  EXPECT_EQ(series.size(), 131u);
  series.forget_from(0);
  EXPECT_EQ(series.size(), 0u);
}

TEST(Session, KeepsTheSettingsInUseWhenItGoesBack) {
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

TEST(Session, PausesAtABlowUpAndOffersTheLastGoodFrame) {
  Session session(doomed_pair(), {}, 1);
  run(session, 40);
  ASSERT_TRUE(session.stability().blow_up());
  EXPECT_TRUE(session.paused);
  EXPECT_EQ(session.stability().blow_up()->body, 1u);
  const int bad = session.stability().blow_up()->frame;
  EXPECT_EQ(session.world().frame(), bad);
  EXPECT_LT(session.stability().last_good_frame(), bad);
  session.rewind_to(session.stability().last_good_frame());
  EXPECT_FALSE(session.stability().blow_up());
  EXPECT_TRUE(softbody::measure(session.world()).finite);
}

TEST(Session, ContinuesThroughABlowUpOnRequest) {
  Session session(doomed_pair(), {}, 1);
  session.pause_on_blow_up = false;
  run(session, 40);
  EXPECT_FALSE(session.stability().blow_up());
  EXPECT_FALSE(session.paused);
  session.reset();
  session.pause_on_blow_up = true;
  run(session, 40);
  ASSERT_TRUE(session.stability().blow_up());
  session.paused = false;
  const int bad = session.world().frame();
  run(session, 5);
  EXPECT_EQ(session.world().frame(), bad + 5) << "it stops once, not in every frame";
  EXPECT_LT(session.stability().past().snapshots().back().frame, bad) << "no bad frame is kept";
  EXPECT_FALSE(session.stability().blow_up()) << "a user who continues has read it";
}

}  // namespace
}  // namespace app
