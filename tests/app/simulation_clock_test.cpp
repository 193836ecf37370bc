#include "app/session/simulation_clock.h"

#include <gtest/gtest.h>

namespace app {
namespace THIS_FILE {

constexpr double frame = 1.0 / 60, tick = 1.0001 * frame;

/// Counts the steps that a clock asks for, each of one frame and no real time.
struct Steps {
  session::SimulationClock clock;
  int count = 0;

  void advance(double elapsed) {
    clock.advance(elapsed, frame, [this] { return take(0); });
  }
  session::SimulationClock::Step take(double ms) {
    ++count;
    return {frame, ms};
  }
};

TEST(SimulationClock, AsksForWholeFramesOfRealTime) {
  Steps steps;
  steps.advance(-1);
  EXPECT_EQ(steps.count, 0) << "time runs backwards";
  for (int i = 0; i < 10; ++i) steps.advance(tick);
  EXPECT_EQ(steps.count, 10);
  for (int i = 0; i < 20; ++i) steps.advance(tick / 2);
  EXPECT_EQ(steps.count, 20);
  EXPECT_EQ(steps.clock.pace(), 1);
}

TEST(SimulationClock, DropsTimeInsteadOfSpiralling) {
  Steps steps;
  steps.advance(1000);
  EXPECT_EQ(steps.count, session::SimulationClock::max_steps);
  EXPECT_LT(steps.clock.pace(), 1);
  steps.advance(0);
  EXPECT_EQ(steps.count, session::SimulationClock::max_steps) << "nothing is owed from before";
  for (int i = 0; i < 60; ++i) steps.advance(tick);
  EXPECT_EQ(steps.count, session::SimulationClock::max_steps + 60);
  EXPECT_GT(steps.clock.pace(), 0.95);
}

TEST(SimulationClock, EndsWithTheStepThatUsesUpTheBudget) {
  Steps steps;
  steps.clock.advance(0.1, frame, [&] { return steps.take(0.4 * 100 + 1); });
  EXPECT_EQ(steps.count, 1);
  steps.clock.advance(0.1, frame, [&] { return steps.take(0.4 * 100 / 2 + 1); });
  EXPECT_EQ(steps.count, 3);
}

TEST(SimulationClock, TellsThatFramesAreCutShort) {
  session::SimulationClock clock;
  for (int i = 0; i < 60; ++i)
    clock.advance(tick, frame, [] { return session::SimulationClock::Step{0.25 * frame, 0}; });
  EXPECT_NEAR(clock.pace(), 0.25, 0.01);
}

TEST(SimulationClock, PausesAndTakesSingleSteps) {
  Steps steps;
  steps.clock.paused = true;
  for (int i = 0; i < 10; ++i) steps.advance(tick);
  EXPECT_EQ(steps.count, 0);
  steps.clock.single_step();
  for (int i = 0; i < 10; ++i) steps.advance(tick);
  EXPECT_EQ(steps.count, 1);
  steps.clock.paused = false;
  steps.clock.single_step();
  EXPECT_TRUE(steps.clock.paused);
}

TEST(SimulationClock, StopsAtTheStepThatPauses) {
  Steps steps;
  steps.clock.advance(10 * tick, frame, [&] {
    steps.clock.paused = true;
    return steps.take(0);
  });
  EXPECT_EQ(steps.count, 1);
}

TEST(SimulationClock, RunsSlowlyByTheFactorAndAheadWithinTheBudget) {
  Steps steps;
  steps.clock.slow_motion = true;
  steps.clock.slow_factor = 0.1;
  for (int i = 0; i < 100; ++i) steps.advance(tick);
  EXPECT_EQ(steps.count, 10);
  steps = {};
  steps.clock.slow_motion = true;
  steps.clock.running_ahead = true;
  steps.advance(tick);
  EXPECT_EQ(steps.count, session::SimulationClock::ahead_factor);
  steps.clock.advance(tick, frame, [&] { return steps.take(session::SimulationClock::step_budget_ms); });
  EXPECT_EQ(steps.count, session::SimulationClock::ahead_factor + 1);
  EXPECT_EQ(steps.clock.pace(), 1) << "measured in real time only";
}

TEST(SimulationClock, TakesOneStepForEachPictureOfARecording) {
  Steps steps;
  const auto step = [&] { return steps.take(1000); };
  steps.clock.advance_one(step);
  EXPECT_EQ(steps.count, 1);
  steps.clock.paused = true;
  steps.clock.advance_one(step);
  EXPECT_EQ(steps.count, 1);
  steps.clock.single_step();
  steps.clock.advance_one(step);
  EXPECT_EQ(steps.count, 2);
}

}  // namespace THIS_FILE
}  // namespace app
