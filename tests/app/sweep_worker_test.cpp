#include "app/session/live/sweep_worker.h"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <thread>

#include "softbody/world/world.h"
#include "tests/app/scenes.h"

namespace app {
namespace THIS_FILE {

using namespace std::chrono_literals;

/// Waits until the sweep has ended and returns its state.
session::SweepState end_of(session::SweepWorker& worker) {
  for (const auto end = std::chrono::steady_clock::now() + 120s; std::chrono::steady_clock::now() < end;) {
    if (const auto state = worker.take(); state && !state->running) return *state;
    std::this_thread::sleep_for(1ms);
  }
  ADD_FAILURE() << "the sweep does not end";
  return {};
}

TEST(SweepWorker, FindsWhatASweepOfTheSameFrameFinds) {
  const softbody::World world(touching_pair(), {});
  constexpr compare::SweepLimits limits{.repetitions = 1};
  session::SweepWorker worker(limits, Runs::in_slices);  // the others have a thread
  EXPECT_FALSE(worker.take());
  worker.start(world, compare::all_methods());
  const session::SweepState state = end_of(worker);
  EXPECT_EQ(state.scene, "Touching pair");
  EXPECT_EQ(state.progress, 1.0);
  EXPECT_EQ(state.stop_reason, "");
  collide::Workers alone(1);
  compare::Sweep expected(world.positions(), compare::sweep_configurations(world), limits, alone);
  while (expected.step()) continue;
  ASSERT_EQ(state.report.rows.size(), expected.report().rows.size());
  EXPECT_EQ(state.report.true_contacts, expected.report().true_contacts);
  for (std::size_t i = 0; i < state.report.rows.size(); ++i) {
    EXPECT_EQ(state.report.rows[i].contacts, expected.report().rows[i].contacts);
    EXPECT_EQ(state.report.rows[i].times.ms.size(), 1u);
  }
}

TEST(SweepWorker, SweepsACopyOfTheFrameWhileTheWorldChanges) {
  session::SweepWorker worker(compare::SweepLimits{.repetitions = 1});
  auto world = std::make_unique<softbody::World>(touching_pair(), softbody::World::Options{});
  for (int i = 0; i < 3; ++i) world->step();
  const std::size_t true_contacts = world->detection().contacts.size();
  worker.start(*world, compare::all_methods());
  for (int i = 0; i < 10; ++i) world->step();
  world.reset();
  const session::SweepState state = end_of(worker);
  EXPECT_EQ(state.frame, 3);
  EXPECT_EQ(state.report.true_contacts, true_contacts);
}

TEST(SweepWorker, KeepsItsResultsWhenCancelledAndCanStartAgain) {
  const softbody::World world(touching_pair(), {});
  session::SweepWorker worker(compare::SweepLimits{.repetitions = 1'000'000});
  for (int i = 0; i < 2; ++i) {
    worker.start(world, compare::all_methods());
    for (bool timed = false; !timed;) {
      if (const auto state = worker.take()) timed = state->progress > 2e-6;  // two rounds
      std::this_thread::sleep_for(1ms);
    }
    EXPECT_FALSE(worker.cancelling());
    worker.cancel();
    EXPECT_TRUE(worker.cancelling());
    const session::SweepState state = end_of(worker);
    EXPECT_FALSE(worker.cancelling());
    EXPECT_EQ(state.stop_reason, "cancelled");
    EXPECT_LT(state.progress, 1);
    for (const compare::SweepRow& row : state.report.rows) EXPECT_TRUE(row.checked);
  }
}

TEST(SweepWorker, IgnoresAStartWhileItRuns) {
  softbody::World world(touching_pair(), {});
  session::SweepWorker worker(compare::SweepLimits{.repetitions = 1'000'000});
  worker.start(world, compare::all_methods());
  world.step();
  worker.start(world, compare::all_methods());
  worker.cancel();
  EXPECT_EQ(end_of(worker).frame, 0);
}

TEST(SweepWorker, CanBeDestroyedWhileItRuns) {
  const softbody::World world(touching_pair(), {});
  for (const bool under_way : {false, true}) {
    session::SweepWorker worker(compare::SweepLimits{.repetitions = 1'000'000});
    worker.start(world, compare::all_methods());
    while (under_way && worker.take().value_or(session::SweepState{}).progress == 0) std::this_thread::sleep_for(1ms);
  }
}

}  // namespace THIS_FILE
}  // namespace app
