// Where the parts of the user interface stand, in small and large windows.

#include <algorithm>

#include <fmt/core.h>

#include "app/ui/panel/panel.h"
#include "app/ui/state/shortcuts.h"
#include "tests/app/keys.h"
#include "tests/app/panel_rig.h"

#include <GLFW/glfw3.h>

namespace app {
namespace THIS_FILE {

TEST(Tooltip, StandsBesideThePanelAndAboveTheComparison) {
  PanelRig rig;
  for (const char* label : {"Reset", "Tolerance", "Contacts", "Hash table"}) {
    rig.hover(label);
    EXPECT_GE(rig.widget("Tooltip").min.x, ui::panel_width) << label;
    EXPECT_LE(rig.widget("Tooltip").max.x, 1280) << label;
  }
  rig.ui.lower = ui::LowerView::comparison;
  rig.frames(3);
  rig.hover("Drive Grid Hash");
  EXPECT_LE(rig.widget("Tooltip").max.y, rig.widget("Column Time").min.y);
}

TEST(Tooltip, KeepsOffTheLightsAndTheComparison) {
  for (const glm::ivec2 size : {glm::ivec2(1280, 720), glm::ivec2(800, 500)}) {
    PanelRig rig;
    rig.ui.lower = ui::LowerView::comparison;
    rig.resize(size.x, size.y);
    for (const ui::WidgetRecorder::Widget& widget : std::vector(rig.recorder.widgets)) {
      if (widget.max.x >= ui::panel_width || widget.max.y >= static_cast<float>(size.y)) continue;
      rig.move(0.5f * (widget.min.x + widget.max.x), 0.5f * (widget.min.y + widget.max.y));
      rig.frames(30);
      if (!rig.shows("Tooltip")) continue;
      for (const char* result : {"Coverage", "Live recall", "Column Time", "Drive Multi-Level SB, exact"})
        if (rig.shows(result)) {
          EXPECT_FALSE(overlap(rig.area("Tooltip"), rig.area(result))) << widget.label << " covers " << result;
        }
    }
  }
}

TEST(Tooltip, WaitsForTheMouseAfterAClick) {
  PanelRig rig;
  rig.hover("Tolerance");
  EXPECT_TRUE(rig.shows("Tooltip"));
  const ImVec2 middle = rig.middle("Tolerance");
  rig.press();
  rig.move(middle.x + 20, middle.y);
  rig.frames(40);
  EXPECT_FALSE(rig.shows("Tooltip")) << "while the button is down";
  rig.release();
  rig.frames(40);
  EXPECT_FALSE(rig.shows("Tooltip")) << "until the mouse moves";
  rig.hover("Tolerance");
  EXPECT_TRUE(rig.shows("Tooltip"));
}

TEST(Layout, NamesThePartsThatHaveNoRoom) {
  PanelRig rig;
  ASSERT_TRUE(rig.ui.hash_table);
  EXPECT_FALSE(rig.shows("No room"));
  rig.resize(800, 500);
  EXPECT_TRUE(rig.shows("No room")) << "for the hash table";
  rig.ui.hash_table = false;
  rig.resize(800, 350);
  EXPECT_FALSE(rig.shows("No room"));
  rig.ui.lower = ui::LowerView::comparison;
  rig.frames(2);
  EXPECT_TRUE(rig.shows("No room")) << "for the comparison";
  rig.resize(1280, 1150);
  EXPECT_FALSE(rig.shows("No room"));
}

TEST(Layout, LeavesTheSceneVisibleAboveTheComparisonAndTheSweep) {
  PanelRig rig;
  for (const glm::ivec2 size : {glm::ivec2(800, 600), glm::ivec2(1280, 720)}) {
    rig.resize(size.x, size.y);
    for (const ui::LowerView view : {ui::LowerView::comparison, ui::LowerView::sweep}) {
      rig.ui.lower = view;
      rig.frames(3);
      const ui::ScreenRect scene = rig.interface.scene_area();
      EXPECT_GE(scene.max.y, 200);
      const bool sweep = view == ui::LowerView::sweep;
      EXPECT_EQ(rig.recorder.find("Scatter") != nullptr, sweep);
      EXPECT_EQ(rig.recorder.find("Column Time") != nullptr, !sweep);
      const float time_line = rig.widget("Time line").min.y;
      EXPECT_GE(time_line, scene.max.y);
      EXPECT_LE(time_line, rig.widget(sweep ? "Sweep" : "Column Time").min.y);
      if (!sweep) continue;
      const ui::WidgetRecorder::Widget plot = rig.widget("Scatter");
      EXPECT_GE(plot.max.y - plot.min.y, 120) << size.x;
      EXPECT_LE(plot.max.y, static_cast<float>(size.y));
    }
  }
}

TEST(Layout, HasRoomForTheComparisonAndTheSweepOfFewAndOfAllMethods) {
  for (const compare::MethodSet& methods : {compare::usual_methods(), compare::all_methods()})
    for (const glm::ivec2 size : {glm::ivec2(1000, 600), glm::ivec2(1280, 720), glm::ivec2(1920, 1080)}) {
      SCOPED_TRACE(size.x);
      PanelRig rig;
      rig.session.comparison.choice.methods = methods;
      rig.ui.lower = ui::LowerView::comparison;
      rig.resize(size.x, size.y);
      float end = rig.area("Shown methods").max.y;
      for (std::size_t m = 0; m < methods.size(); ++m) {
        if (!methods[m]) continue;
        const std::string& name = collide::method_table()[m].name;
        const ui::ScreenRect row = rig.area("Drive " + name);
        EXPECT_GE(row.min.y, end);
        EXPECT_LE(ImGui::CalcTextSize(name.c_str()).x, row.max.x - row.min.x);
        end = row.max.y;
      }
      EXPECT_GE(rig.area("Compare footing").min.y, end);
      EXPECT_LE(rig.area("Compare footing").max.y, static_cast<float>(size.y));
      rig.ui.lower = ui::LowerView::sweep;
      rig.frames(3);
      const ui::ScreenRect plot = rig.area("Scatter");
      EXPECT_GE(plot.max.y - plot.min.y, 180);
      for (const ui::WidgetRecorder::Widget& entry : rig.recorder.widgets) {
        if (!entry.label.starts_with("Legend ")) continue;
        EXPECT_LE(entry.max.x, static_cast<float>(size.x)) << entry.label;
        EXPECT_LE(entry.max.y, plot.min.y) << entry.label;
      }
      EXPECT_LE(rig.area("Sweep footing").max.y, static_cast<float>(size.y));
    }
}

TEST(Layout, ShowsNothingButTheSceneInTheCleanView) {
  PanelRig rig;
  rig.ui.lower = ui::LowerView::comparison;
  rig.ui.story = true;
  rig.frames(3);
  handle_key('X', false, rig.session, rig.ui);
  rig.frames(2);
  EXPECT_TRUE(rig.recorder.widgets.empty());
  const ui::ScreenRect scene = rig.interface.scene_area();
  EXPECT_EQ(scene.min.x, 0);
  EXPECT_EQ(scene.max.x, 1280);
  EXPECT_EQ(scene.max.y, 1150);
  handle_key(GLFW_KEY_ESCAPE, false, rig.session, rig.ui);
  rig.frames(2);
  EXPECT_FALSE(rig.ui.clean);
  EXPECT_TRUE(rig.ui.story) << "the key closes one thing at a time";
  EXPECT_TRUE(rig.recorder.find("Tolerance"));
}

TEST(Layout, KeepsBoxesOverTheSceneApart) {
  for (const glm::ivec2 size :
       {glm::ivec2(640, 480), glm::ivec2(800, 500), glm::ivec2(1280, 720), glm::ivec2(1600, 1000)})
    for (const bool panel : {false, true})
      for (const bool lights : {false, true}) {
        PanelRig rig;
        rig.ui.story = true;
        rig.ui.panel = panel;
        rig.ui.lights = lights;
        rig.ui.hash_table = false;
        rig.ui.overlays.contacts = true;
        rig.resize(size.x, size.y);
        rig.session.simulation.notice.set("something");
        rig.frames(3);
        const auto story = rig.area("Story of Multi-Level SB");
        std::vector<ui::ScreenRect> boxes{
            {{story.min.x, rig.area("Close story").min.y}, rig.area("Story sentence").max}, rig.area("Notice")};
        if (lights) boxes.push_back({rig.area("Coverage").min, rig.area("Live recall").max});
        for (const ui::WidgetRecorder::Widget& line : rig.recorder.widgets)
          if (line.label == "Legend") boxes.push_back({line.min, line.max});
        for (std::size_t i = 0; i < boxes.size(); ++i)
          for (std::size_t j = 0; j < i; ++j)
            EXPECT_FALSE(overlap(boxes[i], boxes[j]))
                << size.x << ", panel " << panel << ", lights " << lights << ", boxes " << i << " and " << j;
      }
}

TEST(Layout, KeepsLegendsWithinTheirArea) {
  for (const float scale : {1.0f, 2.0f}) {
    PanelRig rig(scale);
    for (const render::OverlayRow& row : render::overlay_table) rig.ui.overlays.*row.shown = true;
    rig.change([](softbody::Scene& s) { s.contact_surface = softbody::ContactSurface::surfaces; });
    rig.session.choose_ghost(softbody::IntegratorChoice{"semi-implicit-euler", 1234});
    rig.frames(3);
    const auto expect_lines_end_before = [&](float x) {
      for (const ui::WidgetRecorder::Widget& line : rig.recorder.widgets)
        if (line.label == "Legend") {
          EXPECT_LE(line.max.x, x) << scale;
        }
    };
    ASSERT_LT(rig.interface.scene_area().max.x, 1280 * scale) << "there is no sidebar";
    EXPECT_GE(std::ranges::count(rig.recorder.widgets, "Legend", &ui::WidgetRecorder::Widget::label), 7);
    expect_lines_end_before(1280 * scale - ImGui::GetStyle().WindowPadding.x);
    rig.resize(static_cast<int>(600 * scale), static_cast<int>(900 * scale));
    ASSERT_EQ(rig.interface.scene_area().max.x, 600 * scale) << "there is a sidebar";
    expect_lines_end_before(600 * scale);
  }
}

TEST(Layout, LeavesTheMiddleOfTheSceneFreeWithAllPartsShown) {
  for (const glm::ivec2 size : {glm::ivec2(1280, 720), glm::ivec2(1600, 1000)}) {
    PanelRig rig;
    for (const render::OverlayRow& row : render::overlay_table) rig.ui.overlays.*row.shown = true;
    rig.ui.lower = ui::LowerView::comparison;
    rig.resize(size.x, size.y);
    const ui::ScreenRect scene = rig.interface.scene_area();
    const float width = scene.max.x - scene.min.x, height = scene.max.y - scene.min.y;
    EXPECT_GE(width, 0.5f * static_cast<float>(size.x));
    EXPECT_GE(height, 0.7f * static_cast<float>(size.y));
    for (const char* label : {"Buckets of the table", "Checked frame", "Drive Multi-Level SB"})
      ASSERT_TRUE(rig.recorder.find(label)) << label;
    for (const auto& [label, min, max, enabled] : rig.recorder.widgets) {
      const bool beside = max.x <= scene.min.x || min.x >= scene.max.x || min.y >= scene.max.y;
      const bool at_the_top = max.y <= scene.min.y + 0.25f * height;
      EXPECT_TRUE(beside || at_the_top) << label << " covers the scene";
    }
  }
}

TEST(Tooltip, WaitsForTheMouseWhereAKeyBringsAWidgetToIt) {
  PanelRig rig;
  rig.move(1100, 300);
  handle_key('G', false, rig.session, rig.ui);
  ASSERT_TRUE(rig.frames_until([&] { return rig.shows("Tour claims"); }));
  const ImVec2 at = rig.middle("Tour claims");
  handle_key('G', false, rig.session, rig.ui);
  rig.frames(3);
  rig.move(at.x, at.y);
  handle_key('G', false, rig.session, rig.ui);
  rig.frames(40);
  ASSERT_TRUE(rig.shows("Tour claims"));
  EXPECT_FALSE(rig.shows("Tooltip"));
  rig.move(at.x + 5, at.y);
  rig.frames(40);
  EXPECT_TRUE(rig.shows("Tooltip"));
}

TEST(Help, FitsItsColumnsIntoTheWindow) {
  for (const float scale : {1.0f, 2.0f})
    for (const glm::vec2 size : {glm::vec2(800, 600), glm::vec2(1280, 720)}) {
      PanelRig rig(scale);
      rig.ui.panel = rig.ui.lights = false;
      rig.ui.help = true;
      rig.resize(static_cast<int>(size.x * scale), static_cast<int>(size.y * scale));
      std::vector<ui::ScreenRect> entries;
      for (const auto& [label, min, max, enabled] : rig.recorder.widgets)
        if (label.starts_with("Help ")) entries.push_back({min, max});
      EXPECT_GT(entries.size(), ui::shortcuts().size());
      const ui::ScreenRect close = rig.area("Close");
      EXPECT_LE(close.max.y, size.y * scale);
      for (std::size_t i = 0; i < entries.size(); ++i) {
        EXPECT_LE(entries[i].max.x, size.x * scale);
        EXPECT_LE(entries[i].max.y, close.min.y);
        for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(overlap(entries[i], entries[j])) << i << " and " << j;
      }
    }
}

}  // namespace THIS_FILE
}  // namespace app
