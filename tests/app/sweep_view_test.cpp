#include <algorithm>
#include <map>
#include <utility>

#include "tests/app/keys.h"
#include "tests/app/panel_rig.h"

#include <GLFW/glfw3.h>

namespace app {
namespace THIS_FILE {

/// Runs frames until the sweep's state meets the condition.
template <class Condition>
bool wait_until(PanelRig& rig, const Condition& condition) {
  return rig.frames_until([&] { return condition(rig.session.sweep()); });
}

bool has_ended(const session::SweepState& state) { return !state.running; }

/// Pauses, and opens the window, which starts a sweep.
void sweep(PanelRig& rig) {
  rig.session.simulation.clock.paused = true;
  rig.ui.lower = ui::LowerView::sweep;
  rig.frames(3);
}

TEST(SweepView, PlacesAPointForEachConfigurationByItsTimeAndError) {
  PanelRig rig;
  sweep(rig);
  const std::vector<ui::SweepPlot::Point>& points = rig.interface.sweep_view().plot().points();
  std::size_t before = 0;
  double progress = 0;
  ASSERT_TRUE(wait_until(rig, [&](const session::SweepState& state) {
    EXPECT_GE(state.progress, std::exchange(progress, state.progress));
    EXPECT_GE(points.size(), std::exchange(before, points.size()));
    return !state.running;
  }));
  EXPECT_EQ(rig.session.sweep().progress, 1.0);
  EXPECT_EQ(points.size(), compare::sweep_configurations(rig.session.world(), compare::usual_methods()).size());
  const auto [min, max] = rig.area("Scatter");
  bool missing = false;
  for (const ui::SweepPlot::Point& a : points) {
    EXPECT_TRUE(a.at.x > min.x && a.at.x < max.x && a.at.y > min.y && a.at.y < max.y);
    const compare::SweepRow& row = rig.session.sweep().report.rows[a.row];
    EXPECT_EQ(a.value.error, 1 - row.recall);
    missing = missing || row.recall < 1;
    for (const ui::SweepPlot::Point& b : points) {
      EXPECT_TRUE(a.value.ms >= b.value.ms || a.at.x <= b.at.x);
      EXPECT_TRUE(a.value.error >= b.value.error || a.at.y > b.at.y);
    }
  }
  EXPECT_TRUE(missing) << "the literal method with small cells";
}

TEST(SweepView, RunsAndShowsTheShownMethods) {
  PanelRig rig;
  rig.session.comparison.choice.methods = compare::all_methods();
  sweep(rig);
  ASSERT_TRUE(wait_until(rig, has_ended));
  const auto& points = rig.interface.sweep_view().plot().points();
  const auto methods_with_points = [&] {
    compare::MethodSet methods(collide::method_table().size(), false);
    for (const ui::SweepPlot::Point& point : points) methods[point.method] = true;
    return methods;
  };
  EXPECT_EQ(methods_with_points(), compare::all_methods());
  std::map<float, std::size_t> lanes;
  for (const ui::SweepPlot::Point& point : points)
    if (point.value.error <= 0) {
      EXPECT_EQ(lanes.emplace(point.at.y, point.method).first->second, point.method) << "each method has its lane";
    }
  rig.click("Shown methods");
  rig.click("Trees");
  rig.press_escape();
  compare::MethodSet expected = compare::all_methods();
  for (std::size_t m = 0; m < expected.size(); ++m)
    expected[m] = collide::method_table()[m].group != collide::MethodGroup::trees;
  EXPECT_EQ(methods_with_points(), expected);
  EXPECT_EQ(rig.recorder.find("Legend Octree"), nullptr);
  rig.session.comparison.choice.methods = compare::all_methods();
  rig.frames(2);
  EXPECT_EQ(methods_with_points(), compare::all_methods()) << "the sweep's results were kept";
}

TEST(SweepView, CancelsTheSweepByTheButtonThatBeganIt) {
  PanelRig rig;
  for (int i = 0; i < 30; ++i) rig.session.bodies.drop();  // so that the sweep takes long enough
  sweep(rig);
  ASSERT_TRUE(rig.session.sweep().running);
  rig.click("Sweep");
  ASSERT_TRUE(wait_until(rig, has_ended));
  EXPECT_EQ(rig.session.sweep().stop_reason, "cancelled");
  EXPECT_LT(rig.session.sweep().progress, 1);
}

TEST(SweepView, SweepsTheFrameInWhichItIsOpenedUnlessItKnowsIt) {
  PanelRig rig;
  sweep(rig);
  const int frame = rig.session.world().frame();
  ASSERT_TRUE(wait_until(rig, has_ended));
  const auto toggle = [&] { handle_key(GLFW_KEY_E, false, rig.session, rig.ui); };
  const auto opens_with = [&](int swept, bool running) {
    toggle();
    toggle();
    EXPECT_EQ(rig.session.sweep().frame, swept);
    EXPECT_EQ(rig.session.sweep().running, running);
  };
  opens_with(frame, false);
  rig.session.simulation.clock.single_step();
  rig.frames(2);
  EXPECT_EQ(rig.session.sweep().frame, frame) << "it stays open";
  opens_with(frame + 1, true);
}

TEST(SweepView, AppliesTheSettingsOfTheClickedPoint) {
  PanelRig rig;
  rig.session.comparison.choice.methods = compare::all_methods();
  sweep(rig);
  ASSERT_TRUE(wait_until(rig, has_ended));
  const ui::SweepView& view = rig.interface.sweep_view();
  std::vector<bool> clicked(collide::method_table().size());
  for (std::size_t i = 0; i < view.plot().points().size(); ++i) {
    const ui::SweepPlot::Point point = view.plot().points()[i];
    if (clicked[point.method]) continue;
    rig.click_at(point.at.x, point.at.y);
    // Several points may lie at the same place: then the click may have chosen any of them.
    const collide::Method& method = rig.session.world().method();
    const bool matches = std::ranges::any_of(view.plot().points(), [&](const ui::SweepPlot::Point& other) {
      const compare::Configuration& c = rig.session.sweep().report.rows[other.row].configuration;
      const collide::Settings& now = rig.session.world().collision();
      return std::abs(other.at.x - point.at.x) < 9 && std::abs(other.at.y - point.at.y) < 9 &&
             collide::method_table()[c.method].key == method.key &&
             (!method.uses_levels || c.settings.levels == now.levels) &&
             (!method.uses_hash || (c.settings.buckets == now.buckets && c.settings.cell_size == now.cell_size &&
                                    (c.cell == 1) == !rig.session.world().scene().collision.cell_size));
    });
    EXPECT_TRUE(matches) << "point " << i;
    clicked[compare::method_index(method.key)] = true;
  }
  EXPECT_EQ(std::ranges::count(clicked, true), static_cast<std::ptrdiff_t>(clicked.size()));
}

TEST(SweepView, KeepsEverythingInPlaceDuringTheSweep) {
  PanelRig rig(2);
  rig.session.simulation.clock.paused = true;
  rig.ui.lower = ui::LowerView::sweep;
  rig.frames(3);
  const auto before = rig.recorder.widgets;
  ASSERT_TRUE(wait_until(rig, [](const session::SweepState& state) { return state.progress > 0.3; }));
  rig.expect_in_place(before, "Coverage");  // whose sentence changes
}

}  // namespace THIS_FILE
}  // namespace app
