#include <algorithm>

#include "app/ui/shortcuts.h"
#include "tests/app/panel_rig.h"

#include <GLFW/glfw3.h>

namespace app {
namespace {

/// Runs frames until the rows of a report meet the condition.
template <class Condition>
bool wait_until(PanelRig& rig, const Condition& condition) {
  return rig.frames_until([&] {
    const compare::CompareReport& report = rig.session.comparison.report();
    return !report.rows.empty() && condition(report.rows);
  });
}

bool all_timed(const std::vector<compare::CompareRow>& rows) {
  return std::ranges::count(rows, true, [](const compare::CompareRow& row) { return row.ms.has_value(); }) == 5;
}

TEST(CompareView, IsOffAtFirstAndSwitchedByPanelAndKey) {
  PanelRig rig;
  EXPECT_FALSE(rig.session.comparison.choice.on);
  EXPECT_EQ(rig.recorder.find("Drive Grid Hash"), nullptr);
  ASSERT_TRUE(
      wait_until(rig, [](const auto& rows) { return std::ranges::any_of(rows, &compare::CompareRow::scored); }));
  EXPECT_EQ(std::ranges::count(rig.session.comparison.report().rows, true, &compare::CompareRow::scored),
            2);  // driver and reference
  rig.click("Compare methods");
  EXPECT_TRUE(rig.session.comparison.choice.on);
  EXPECT_NE(rig.recorder.find("Drive Grid Hash"), nullptr);
  ui::handle_key(GLFW_KEY_V, false, rig.session, rig.ui);
  rig.frame();
  EXPECT_FALSE(rig.session.comparison.choice.on);
}

TEST(CompareView, MakesTheClickedMethodTheDriver) {
  PanelRig rig;
  rig.ui.lower = ui::LowerView::comparison;
  rig.frames(3);
  for (const collide::Method& method : collide::method_table()) {
    rig.click("Drive " + std::string(method.name));
    EXPECT_EQ(rig.session.world().method().key, method.key);
  }
}

TEST(CompareView, RunsOnlyTheChosenMethods) {
  PanelRig rig;
  rig.ui.lower = ui::LowerView::comparison;
  ASSERT_TRUE(wait_until(rig, all_timed));
  EXPECT_EQ(rig.recorder.find("Run Brute force"), nullptr);  // the reference always runs
  rig.click("Run Bounding Box");
  const std::size_t method = compare::method_index("bounding-box");
  ASSERT_TRUE(wait_until(rig, [&](const auto& rows) { return !rows[method].ms; }));
  EXPECT_FALSE(rig.session.comparison.report().rows[method].scored);
  EXPECT_EQ(rig.session.comparison.method_ms()[method].size(), 0u);
  rig.click("Run Bounding Box");
  EXPECT_TRUE(wait_until(rig, all_timed));
}

TEST(CompareView, ShowsWhatTheChosenMethodMisses) {
  PanelRig rig;
  rig.session.simulation.clock.paused = true;
  collide::Settings settings = rig.session.world().collision();
  settings.cell_size = glm::vec3(0.13f);
  settings.buckets = 1'000'003;
  rig.session.settings.set_collision(settings, false);
  rig.ui.lower = ui::LowerView::comparison;
  const std::size_t literal = compare::method_index("multi-level-sb");
  ASSERT_TRUE(wait_until(rig, [&](const auto& rows) { return rows[literal].scored && rows[literal].recall < 1; }));
  ASSERT_NE(rig.session.comparison.missed(), nullptr);
  EXPECT_FALSE(rig.session.comparison.missed()->empty()) << "the paper's method, unless another one is chosen";
  EXPECT_FALSE(rig.ui.overlays.missed);
  rig.click("Misses of Grid Hash");
  EXPECT_TRUE(rig.ui.overlays.missed);
  EXPECT_TRUE(rig.session.comparison.missed()->empty()) << "it is exact";
}

TEST(CompareView, KeepsEverythingInPlaceWhileItMeasures) {
  for (const float scale : {1.0f, 2.0f}) {
    PanelRig rig(scale);
    rig.ui.lower = ui::LowerView::comparison;
    rig.frames(3);
    const auto before = rig.recorder.widgets;
    ASSERT_TRUE(wait_until(rig, all_timed));
    rig.frames(2);
    rig.expect_in_place(before, "Coverage");  // whose sentence changes
  }
}

}  // namespace
}  // namespace app
