// The past within its bounds of memory: snapshots and curves.

#include <gtest/gtest.h>

#include "app/session/session.h"
#include "tests/app/scenes.h"

namespace app {
namespace THIS_FILE {

void run(Session& session, int frames) {
  for (int i = 0; i < frames; ++i) session.advance(tick);
}

TEST(Rewind, StaysWithinItsMemoryWithGapsThatGrowWithAge) {
  softbody::World world(touching_pair(), {});
  const std::size_t one = world.snapshot().bytes();
  session::Rewind past(12 * one);
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
  for (std::size_t i = 1; i + 1 < list.size(); ++i) EXPECT_GE(gap(i), session::Rewind::period);
  EXPECT_GE(list[list.size() - 2].frame, 400 - 3 * session::Rewind::period);
  EXPECT_GT(gap(1), 4 * gap(list.size() - 2));
  std::size_t sum = 0;
  for (const softbody::Snapshot& s : list) sum += s.bytes();
  EXPECT_EQ(past.bytes(), sum);
}

TEST(Rewind, KeepsOneSnapshotOfAnySize) {
  softbody::World world(touching_pair(), {});
  session::Rewind past(1);
  for (int i = 0; i < 12; ++i) {
    past.keep(world);
    EXPECT_EQ(past.snapshots().size(), 1u);
    EXPECT_EQ(past.snapshots()[0].frame, i);
    world.step();
  }
}

TEST(Rewind, ForgetsLaterSnapshotsAfterGoingBack) {
  softbody::World world(touching_pair(), {});
  session::Rewind past;
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
    session.simulation.change_scene("Contact", [&](softbody::Scene& s) { s.contact_surface = surface; });
    for (int round = 0; round < 6; ++round) {
      run(session, 50);
      session.bodies.drop();
      run(session, 10);
      collide::Settings settings = session.world().collision();
      settings.tolerance = round % 2 ? 0.1f : 0.4f;
      session.simulation.change_scene(
          "Settings", [&](softbody::Scene& s) { s.collision = settings, s.collision.cell_size.reset(); });
    }
    EXPECT_FALSE(session.simulation.stability().blow_up()) << session.simulation.stability().blow_up()->what;
    EXPECT_FALSE(session.simulation.clock.paused);
  }
}

TEST(TimeSeries, KeepsTheLastValuesInOrder) {
  TimeSeries series;
  EXPECT_EQ(series.size(), 0u);
  for (std::size_t i = 0; i < TimeSeries::capacity + 5; ++i)
    series.push(static_cast<int>(2 * i), static_cast<float>(i));
  EXPECT_EQ(series.size(), TimeSeries::capacity);
  EXPECT_EQ(series[0], 5.0f);
  EXPECT_EQ(series.frame(0), 10);
  EXPECT_EQ(series[TimeSeries::capacity - 1], static_cast<float>(TimeSeries::capacity + 4));
  EXPECT_EQ(series.max(), static_cast<float>(TimeSeries::capacity + 4));
  EXPECT_EQ(series.median(3), static_cast<float>(TimeSeries::capacity + 3));
  EXPECT_EQ(TimeSeries().median(3), 0.0f);
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

}  // namespace THIS_FILE
}  // namespace app
