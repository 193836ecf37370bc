#include <algorithm>
#include <chrono>

#include "app/ui/shortcuts.h"
#include "tests/app/panel_rig.h"

#include <GLFW/glfw3.h>

namespace app {
namespace {

using namespace std::chrono_literals;

/// Draws until the sweep's state meets the condition; the worker takes its time.
template <class Condition>
bool wait_until(PanelRig& rig, const Condition& condition) {
  for (const auto end = std::chrono::steady_clock::now() + 120s; std::chrono::steady_clock::now() < end;) {
    rig.frame();
    if (condition(rig.interface.sweep_view().state())) return true;
  }
  return false;
}

bool has_ended(const SweepState& state) { return !state.running; }

/// Pauses, opens the window and begins to sweep.
void sweep(PanelRig& rig) {
  rig.session.paused = true;
  rig.ui.sweep = true;
  rig.frames(3);
  rig.click("Sweep");
}

/// Takes the state until the sweep has ended.
SweepState end_of(SweepWorker& worker) {
  for (const auto end = std::chrono::steady_clock::now() + 120s; std::chrono::steady_clock::now() < end;) {
    if (const auto state = worker.take(); state && !state->running) return *state;
    std::this_thread::sleep_for(1ms);
  }
  ADD_FAILURE() << "the sweep does not end";
  return {};
}

TEST(SweepWorker, FindsWhatASweepOfTheSameFrameFinds) {
  const softbody::World world(touching_pair(), {});
  constexpr SweepLimits limits{.repetitions = 1};
  SweepWorker worker(limits);
  EXPECT_FALSE(worker.take());
  worker.start(world);
  const SweepState state = end_of(worker);
  EXPECT_EQ(state.scene, "Touching pair");
  EXPECT_EQ(state.progress, 1.0);
  EXPECT_EQ(state.stop_reason, "");
  collide::Workers alone(1);
  Sweep expected(world.positions(), sweep_configurations(world), limits, alone);
  while (expected.step()) continue;
  ASSERT_EQ(state.report.rows.size(), expected.report().rows.size());
  EXPECT_EQ(state.report.true_contacts, expected.report().true_contacts);
  for (std::size_t i = 0; i < state.report.rows.size(); ++i) {
    EXPECT_EQ(state.report.rows[i].contacts, expected.report().rows[i].contacts);
    EXPECT_EQ(state.report.rows[i].times.ms.size(), 1u);
  }
}

TEST(SweepWorker, SweepsACopyOfTheFrameWhateverBecomesOfTheWorld) {
  SweepWorker worker(SweepLimits{.repetitions = 1});
  auto world = std::make_unique<softbody::World>(touching_pair(), softbody::World::Options{});
  for (int i = 0; i < 3; ++i) world->step();
  const std::size_t true_contacts = world->detection().contacts.size();
  worker.start(*world);
  for (int i = 0; i < 10; ++i) world->step();
  world.reset();
  const SweepState state = end_of(worker);
  EXPECT_EQ(state.frame, 3);
  EXPECT_EQ(state.report.true_contacts, true_contacts);
}

TEST(SweepWorker, KeepsWhatItKnowsWhenCancelledAndCanBeginAnew) {
  const softbody::World world(touching_pair(), {});
  SweepWorker worker(SweepLimits{.repetitions = 1'000'000});
  for (int i = 0; i < 2; ++i) {
    worker.start(world);
    for (bool timed = false; !timed;) {
      if (const auto state = worker.take()) timed = state->progress > 2e-6;  // two rounds
      std::this_thread::sleep_for(1ms);
    }
    EXPECT_FALSE(worker.cancelling());
    worker.cancel();
    EXPECT_TRUE(worker.cancelling());
    const SweepState state = end_of(worker);
    EXPECT_FALSE(worker.cancelling());
    EXPECT_EQ(state.stop_reason, "cancelled");
    EXPECT_LT(state.progress, 1);
    for (const SweepRow& row : state.report.rows) EXPECT_TRUE(row.checked);
  }
}

TEST(SweepWorker, DoesNothingWhenAskedToBeginWhileItRuns) {
  softbody::World world(touching_pair(), {});
  SweepWorker worker(SweepLimits{.repetitions = 1'000'000});
  worker.start(world);
  world.step();
  worker.start(world);
  worker.cancel();
  EXPECT_EQ(end_of(worker).frame, 0);
}

TEST(SweepWorker, CanGoWhileItRuns) {
  const softbody::World world(touching_pair(), {});
  for (const bool under_way : {false, true}) {
    SweepWorker worker(SweepLimits{.repetitions = 1'000'000});
    worker.start(world);
    while (under_way && worker.take().value_or(SweepState{}).progress == 0) std::this_thread::sleep_for(1ms);
  }
}

TEST(SweepView, IsOpenedByPanelAndKey) {
  PanelRig rig;
  EXPECT_EQ(rig.recorder.find("Sweep"), nullptr);
  rig.click("Error against run time");
  rig.frames(2);
  EXPECT_NE(rig.recorder.find("Sweep"), nullptr);
  EXPECT_TRUE(rig.interface.sweep_view().plot().points().empty());
  press(GLFW_KEY_E, false, rig.session, rig.ui);
  rig.frames(2);
  EXPECT_EQ(rig.recorder.find("Sweep"), nullptr);
}

TEST(SweepView, PointsComeWhileTheSweepGoesOnAndStayInsideThePlot) {
  PanelRig rig;
  sweep(rig);
  std::size_t before = 0;
  double progress = 0;
  ASSERT_TRUE(wait_until(rig, [&](const SweepState& state) {
    EXPECT_GE(state.progress, progress);
    EXPECT_GE(rig.interface.sweep_view().plot().points().size(), before);
    progress = state.progress;
    before = rig.interface.sweep_view().plot().points().size();
    return !state.running;
  }));
  const SweepView& view = rig.interface.sweep_view();
  EXPECT_EQ(view.state().progress, 1.0);
  EXPECT_EQ(view.plot().points().size(), sweep_configurations(rig.session.world()).size());
  const Recorder::Widget plot = rig.widget("Scatter");
  bool missing = false;
  for (const SweepPlot::Point& point : view.plot().points()) {
    EXPECT_TRUE(point.at.x > plot.min.x && point.at.x < plot.max.x && point.at.y > plot.min.y &&
                point.at.y < plot.max.y);
    const SweepRow& row = view.state().report.rows[point.row];
    EXPECT_EQ(point.value.error, 1 - row.recall);
    missing = missing || row.recall < 1;
  }
  EXPECT_TRUE(missing) << "the literal method with small cells";
}

TEST(SweepView, AxesGrowWithTimeAndError) {
  PanelRig rig;
  sweep(rig);
  ASSERT_TRUE(wait_until(rig, has_ended));
  const auto& points = rig.interface.sweep_view().plot().points();
  for (const auto& a : points) {
    for (const auto& b : points) {
      EXPECT_TRUE(a.value.ms >= b.value.ms || a.at.x <= b.at.x);
      EXPECT_TRUE(a.value.error >= b.value.error || a.at.y > b.at.y);
    }
  }
}

TEST(SweepView, IsCancelledByTheButtonThatBeganIt) {
  PanelRig rig;
  for (int i = 0; i < 30; ++i) rig.session.drop();  // so that the sweep takes long enough
  sweep(rig);
  ASSERT_TRUE(rig.interface.sweep_view().state().running);
  rig.click("Sweep");
  ASSERT_TRUE(wait_until(rig, has_ended));
  EXPECT_EQ(rig.interface.sweep_view().state().stop_reason, "cancelled");
  EXPECT_LT(rig.interface.sweep_view().state().progress, 1);
}

TEST(SweepView, GoesOnWithItsFrameWhileItsWindowIsClosedAndTheWorldAnother) {
  PanelRig rig;
  rig.frames(5);
  sweep(rig);
  const int frame = rig.session.world().frame();
  ASSERT_GT(frame, 0);
  rig.ui.sweep = false;
  rig.session.reset();
  rig.frames(5);
  rig.ui.sweep = true;
  ASSERT_TRUE(wait_until(rig, has_ended));
  EXPECT_EQ(rig.interface.sweep_view().state().frame, frame);
  EXPECT_EQ(rig.interface.sweep_view().state().progress, 1.0);
}

TEST(SweepView, AClickOnAPointMakesItsSettingsThoseOfTheDemo) {
  PanelRig rig;
  sweep(rig);
  ASSERT_TRUE(wait_until(rig, has_ended));
  const SweepView& view = rig.interface.sweep_view();
  std::vector<bool> clicked(collide::method_table().size());
  for (std::size_t i = 0; i < view.plot().points().size(); ++i) {
    const SweepPlot::Point point = view.plot().points()[i];
    if (clicked[point.method]) continue;
    rig.click_at(point.at.x, point.at.y);
    // Another point may lie at the very same place: then the one that answers is as good.
    const collide::Method& method = rig.session.world().method();
    const bool matches = std::ranges::any_of(view.plot().points(), [&](const SweepPlot::Point& other) {
      const Configuration& c = view.state().report.rows[other.row].configuration;
      const collide::Settings& now = rig.session.world().collision();
      return std::abs(other.at.x - point.at.x) < 9 && std::abs(other.at.y - point.at.y) < 9 &&
             collide::method_table()[c.method].key == method.key &&
             (!method.uses_levels || c.settings.levels == now.levels) &&
             (!method.uses_hash || (c.settings.buckets == now.buckets && c.settings.cell_size == now.cell_size &&
                                    (c.cell == 1) == rig.session.world().uses_default_cell_size()));
    });
    EXPECT_TRUE(matches) << "point " << i;
    clicked[method_index(method.key)] = true;
  }
  EXPECT_EQ(std::ranges::count(clicked, true), static_cast<std::ptrdiff_t>(clicked.size()));
}

TEST(SweepView, NothingMovesWhileItSweeps) {
  for (const float scale : {1.0f, 2.0f}) {
    PanelRig rig(scale);
    rig.session.paused = true;
    rig.ui.sweep = true;
    rig.frames(3);
    const auto before = rig.recorder.widgets;
    rig.click("Sweep");
    ASSERT_TRUE(wait_until(rig, [](const SweepState& state) { return state.progress > 0.3; }));
    for (const Recorder::Widget& was : before) {
      const Recorder::Widget is = rig.widget(was.label);
      if (was.label == "Coverage") continue;  // a sentence of its own length
      EXPECT_EQ(is.min.x, was.min.x) << was.label;
      EXPECT_EQ(is.min.y, was.min.y) << was.label;
      EXPECT_EQ(is.max.x, was.max.x) << was.label;
      EXPECT_EQ(is.max.y, was.max.y) << was.label;
    }
  }
}

}  // namespace
}  // namespace app
