#include "app/session/live/sweep_worker.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <new>

#include "softbody/world/world.h"
#include "tests/app/scenes.h"

namespace {
thread_local std::size_t refused_bytes = 0;  // a block of so many bytes is not to be had; 0: all are
}  // namespace

void* operator new(std::size_t bytes) {
  void* block = bytes > 0 && bytes == refused_bytes ? nullptr : std::malloc(bytes);
  return block ? block : throw std::bad_alloc();
}
void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }

namespace app {
namespace THIS_FILE {

/// Waits for a state of the sweep that is `wanted`, and returns it.
session::SweepState wait_for(session::SweepWorker& worker, const auto& wanted) {
  EXPECT_TRUE(wait_until([&] {
    worker.update();
    return wanted(worker.state());
  }));
  return worker.state();
}
session::SweepState end_of(session::SweepWorker& worker) {
  return wait_for(worker, [](const session::SweepState& state) { return !state.running; });
}

TEST(SweepWorker, FindsWhatASweepOfTheSameFrameFinds) {
  const softbody::World world(touching_pair(), {});
  constexpr compare::SweepLimits limits{.repetitions = 1};
  session::SweepWorker worker(limits, Runs::in_slices);  // the others have a thread
  EXPECT_EQ(worker.state().scene, "");
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
  world->step();
  worker.start(*world, compare::all_methods());  // nothing, while it runs
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
    wait_for(worker, [](const session::SweepState& state) { return state.progress > 2e-6; });  // two rounds
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

TEST(SweepWorker, KeepsItsResultsWhenThereIsTooLittleMemoryToCopyThem) {
  const softbody::World world(touching_pair(), {});
  session::SweepWorker worker(compare::SweepLimits{.repetitions = 1'000'000}, Runs::in_slices);
  worker.start(world, compare::all_methods());
  wait_for(worker, [](const session::SweepState& state) { return state.progress > 2e-6; });
  const session::SweepState& state = worker.state();
  refused_bytes = state.report.rows.size() * sizeof(compare::SweepRow);
  while (state.running) worker.update();
  refused_bytes = 0;
  EXPECT_EQ(state.stop_reason, "failed: not enough memory");
  EXPECT_LT(state.progress, 1);
  EXPECT_FALSE(state.report.rows.empty());
  for (const compare::SweepRow& row : state.report.rows) EXPECT_TRUE(row.checked);
}

TEST(SweepWorker, CanBeDestroyedWhileItRuns) {
  const softbody::World world(touching_pair(), {});
  for (const bool under_way : {false, true}) {
    session::SweepWorker worker(compare::SweepLimits{.repetitions = 1'000'000});
    worker.start(world, compare::all_methods());
    if (under_way) wait_for(worker, [](const session::SweepState& state) { return state.progress > 0; });
  }
}

}  // namespace THIS_FILE
}  // namespace app
