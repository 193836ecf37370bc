// Where the parts of the user interface stand, in small and large windows.

#include <algorithm>

#include <fmt/core.h>

#include "app/ui/panel/panel.h"
#include "app/ui/shortcuts.h"
#include "tests/app/keys.h"
#include "tests/app/panel_rig.h"

#include <GLFW/glfw3.h>

namespace app {
namespace THIS_FILE {

TEST(Tooltip, StandsBesideThePanel) {
  PanelRig rig;
  for (const char* label : {"Reset", "Tolerance", "Contacts", "Detect"}) {
    const auto [name, min, max, enabled] = rig.widget(label);
    rig.move(0.5f * (min.x + max.x), 0.5f * (min.y + max.y));
    rig.frames(40);  // the mouse rests
    EXPECT_GE(rig.widget("Tooltip").min.x, ui::panel_width) << label;
    EXPECT_LE(rig.widget("Tooltip").max.x, 1280) << label;
  }
}

TEST(Tooltip, StandsAboveTheComparison) {
  PanelRig rig;
  rig.ui.lower = ui::LowerView::comparison;
  rig.frames(3);
  const ui::WidgetRecorder::Widget head = rig.widget("Column Time"), row = rig.widget("Drive Grid Hash");
  rig.move(0.5f * (row.min.x + row.max.x), 0.5f * (row.min.y + row.max.y));
  rig.frames(40);
  EXPECT_LE(rig.widget("Tooltip").max.y, head.min.y);
}

TEST(Tooltip, KeepsOffTheLightsAndTheComparison) {
  for (const ImVec2 size : {ImVec2{1280, 720}, ImVec2{800, 500}}) {
    PanelRig rig;
    rig.ui.lower = ui::LowerView::comparison;
    rig.resize(static_cast<int>(size.x), static_cast<int>(size.y));
    for (const ui::WidgetRecorder::Widget& widget : std::vector(rig.recorder.widgets)) {
      const bool of_panel = widget.max.x < ui::panel_width && widget.max.y < size.y;
      if (!of_panel) continue;
      rig.move(0.5f * (widget.min.x + widget.max.x), 0.5f * (widget.min.y + widget.max.y));
      rig.frames(30);
      if (!rig.recorder.find("Tooltip")) continue;
      const ui::WidgetRecorder::Widget tip = rig.widget("Tooltip");
      for (const char* result :
           {"Coverage", "Live recall", "Step light", "Column Time", "Drive Multi-Level SB, exact"}) {
        const ui::WidgetRecorder::Widget* shown = rig.recorder.find(result);
        if (!shown) continue;
        const bool apart = tip.max.x <= shown->min.x || tip.min.x >= shown->max.x || tip.max.y <= shown->min.y ||
                           tip.min.y >= shown->max.y;
        EXPECT_TRUE(apart) << widget.label << " covers " << result;
      }
    }
  }
}

TEST(Tooltip, WaitsForTheMouseAfterAClick) {
  PanelRig rig;
  const auto [name, min, max, enabled] = rig.widget("Tolerance");
  const ImVec2 middle{0.5f * (min.x + max.x), 0.5f * (min.y + max.y)};
  rig.move(middle.x, middle.y);
  rig.frames(40);
  EXPECT_TRUE(rig.recorder.find("Tooltip"));
  rig.press();
  rig.move(middle.x + 20, middle.y);
  rig.frames(40);
  EXPECT_FALSE(rig.recorder.find("Tooltip")) << "while the button is down";
  rig.release();
  rig.frames(40);
  EXPECT_FALSE(rig.recorder.find("Tooltip")) << "until the mouse moves";
  rig.move(middle.x, middle.y);
  rig.frames(40);
  EXPECT_TRUE(rig.recorder.find("Tooltip"));
}

TEST(Layout, NamesThePartsThatHaveNoRoom) {
  PanelRig rig;
  rig.frames(2);
  ASSERT_TRUE(rig.ui.hash_table);
  EXPECT_FALSE(rig.recorder.find("No room"));
  rig.resize(800, 500);
  EXPECT_TRUE(rig.recorder.find("No room")) << "for the hash table";
  rig.ui.hash_table = false;
  rig.resize(800, 350);
  EXPECT_FALSE(rig.recorder.find("No room"));
  rig.ui.lower = ui::LowerView::comparison;
  rig.frames(2);
  EXPECT_TRUE(rig.recorder.find("No room")) << "for the comparison";
  rig.resize(1280, 1150);
  EXPECT_FALSE(rig.recorder.find("No room"));
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
        const auto box = [&](const char* first, const char* last) {
          return ui::ScreenRect{rig.widget(first).min, {rig.widget(last).max.x, rig.widget(last).max.y}};
        };
        std::vector<ui::ScreenRect> boxes{box("Story of Multi-Level SB", "Story sentence"), box("Notice", "Notice")};
        boxes[0].min.y = rig.widget("Close story").min.y;
        if (lights) boxes.push_back(box("Coverage", "Step light"));
        for (const ui::WidgetRecorder::Widget& line : rig.recorder.widgets)
          if (line.label == "Legend") boxes.push_back({line.min, line.max});
        for (std::size_t i = 0; i < boxes.size(); ++i)
          for (std::size_t j = 0; j < i; ++j) {
            const ui::ScreenRect &p = boxes[i], &q = boxes[j];
            EXPECT_TRUE(p.max.x <= q.min.x || q.max.x <= p.min.x || p.max.y <= q.min.y || q.max.y <= p.min.y)
                << size.x << ", panel " << panel << ", lights " << lights << ", boxes " << i << " and " << j;
          }
      }
}

TEST(Layout, KeepsLegendsWithinTheirArea) {
  for (const float scale : {1.0f, 2.0f}) {
    PanelRig rig(scale);
    for (const render::OverlayRow& row : render::overlay_table) rig.ui.overlays.*row.shown = true;
    rig.session.simulation.change_scene(
        "Contact", [&](softbody::Scene& s) { s.contact_surface = softbody::ContactSurface::surfaces; });
    rig.session.choose_ghost(softbody::IntegratorChoice{"semi-implicit-euler", 1234});
    rig.frames(3);
    const float display = 1280 * scale;
    ASSERT_LT(rig.interface.scene_area().max.x, display) << "there is no sidebar";
    EXPECT_GE(std::ranges::count(rig.recorder.widgets, "Legend", &ui::WidgetRecorder::Widget::label), 7);
    for (const ui::WidgetRecorder::Widget& line : rig.recorder.widgets)
      if (line.label == "Legend") {
        EXPECT_LE(line.max.x, display - ImGui::GetStyle().WindowPadding.x);
      }
    rig.resize(static_cast<int>(600 * scale), static_cast<int>(900 * scale));
    ASSERT_EQ(rig.interface.scene_area().max.x, 600 * scale) << "there is a sidebar";
    for (const ui::WidgetRecorder::Widget& line : rig.recorder.widgets)
      if (line.label == "Legend") {
        EXPECT_LE(line.max.x, 600 * scale) << "over the scene";
      }
  }
}

TEST(Layout, FitsTheTourIntoSmallWindows) {
  PanelRig rig;
  for (const glm::ivec2 size : {glm::ivec2(640, 480), glm::ivec2(500, 400), glm::ivec2(1280, 720)}) {
    rig.resize(size.x, size.y);
    rig.ui.tour.start(rig.session, rig.ui.overlays);
    rig.frames(3);
    for (const char* label : {"Back", "Next", "Close tour"}) {
      const ui::WidgetRecorder::Widget button = rig.widget(label);
      EXPECT_LE(button.max.x, static_cast<float>(size.x)) << label;
      EXPECT_LE(button.max.y, static_cast<float>(size.y)) << label;
    }
    const ui::ScreenRect scene = rig.interface.scene_area();
    EXPECT_GT(scene.max.x - scene.min.x, 200);
    EXPECT_GT(scene.max.y - scene.min.y, 150);
    rig.ui.tour.close(rig.session, rig.ui.overlays);
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

TEST(Help, OpensAndCloses) {
  PanelRig rig;
  rig.click("?");
  rig.frames(2);
  ASSERT_TRUE(rig.ui.help);
  rig.click("Close");
  EXPECT_FALSE(rig.ui.help);
}

TEST(Help, SeparatesItsColumns) {
  for (const float scale : {1.0f, 2.0f}) {
    PanelRig rig(scale);
    rig.ui.help = true;
    rig.frames(3);
    float first_ends = 0;
    for (const ui::Shortcut& shortcut : ui::shortcuts())
      first_ends = std::max(first_ends, rig.widget(fmt::format("Help {}", shortcut.text)).max.x);
    const float keys =
        rig.widget(fmt::format("Help {}", ui::shortcuts()[0].text)).min.x;  // the keys' column is as wide for each text
    const float width = keys - rig.widget("Close").min.x;
    for (const render::OverlayRow& row : render::overlay_table)
      EXPECT_GT(rig.widget(fmt::format("Help {}", row.label)).min.x - width, first_ends) << row.label;
  }
}

}  // namespace THIS_FILE
}  // namespace app
