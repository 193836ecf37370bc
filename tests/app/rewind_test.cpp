// The past within its bounds of memory: snapshots and curves.

#include <gtest/gtest.h>

#include "app/session/body_controls.h"
#include "tests/app/scenes.h"

namespace app {
namespace THIS_FILE {

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
  for (int i = 0; i < 3; ++i) {
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
    session::Simulation simulation(touching_pair(), 1);
    simulation.change_scene("Contact", [&](softbody::Scene& s) { s.contact_surface = surface; });
    for (int round = 0; round < 3; ++round) {
      run(simulation, 50);
      session::BodyControls(simulation).drop();
      run(simulation, 10);
      simulation.change_scene("Settings", [&](softbody::Scene& s) { s.collision.tolerance = round % 2 ? 0.1f : 0.4f; });
    }
    EXPECT_FALSE(simulation.stability().blow_up()) << simulation.stability().blow_up()->what;
    EXPECT_FALSE(simulation.clock.paused);
  }
}

TEST(TimeSeries, KeepsTheLastValuesAndForgetsThoseFromAFrameOn) {
  TimeSeries series;
  EXPECT_EQ(series.median(3), 0.0f);
  for (int frame = 0; frame < 300; ++frame) series.push(frame, static_cast<float>(2 * frame));
  EXPECT_EQ(series.size(), TimeSeries::capacity);
  EXPECT_EQ(series.frame(0), 120);
  EXPECT_EQ(series[0], 240.0f);
  EXPECT_EQ(series.latest(), 598.0f);
  EXPECT_EQ(series.median(3), 596.0f);
  series.forget_from(250);
  EXPECT_EQ(series.latest(), 498);
  EXPECT_EQ(series.max(), 498);
  EXPECT_EQ(series.min(), 240);
  series.push(250, -1);
  EXPECT_EQ(series.min(), -1);
  EXPECT_EQ(series.size(), 131u);
  series.forget_from(0);
  EXPECT_EQ(series.size(), 0u);
}

}  // namespace THIS_FILE
}  // namespace app
