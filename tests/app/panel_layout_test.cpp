// Where things stand: tooltips, lists, folds, small windows and high-density screens.

#include <algorithm>

#include <fmt/core.h>

#include "app/ui/panel/panel.h"
#include "app/ui/shortcuts.h"
#include "tests/app/panel_rig.h"

#include <GLFW/glfw3.h>

namespace app {
namespace {

TEST(Panel, TooltipsStandBesideThePanel) {
  PanelRig rig;
  for (const char* label : {"Pause", "Tolerance", "Contacts", "Detect"}) {
    const auto [name, min, max, enabled] = rig.widget(label);
    rig.move(0.5f * (min.x + max.x), 0.5f * (min.y + max.y));
    rig.frames(40);  // it rests
    EXPECT_GE(rig.widget("Tooltip").min.x, panel_width) << label;
    EXPECT_LE(rig.widget("Tooltip").max.x, 1280) << label;
  }
}

TEST(Panel, TooltipsOfTheComparisonStandAboveIt) {
  PanelRig rig;
  rig.session.compare.on = true;
  rig.frames(3);
  const Recorder::Widget head = rig.widget("Column Method"), row = rig.widget("Drive Grid Hash");
  rig.move(0.5f * (row.min.x + row.max.x), 0.5f * (row.min.y + row.max.y));
  rig.frames(40);
  EXPECT_LE(rig.widget("Tooltip").max.y, head.min.y);
}

TEST(Panel, EscapeClosesAnOpenListAndNothingElse) {
  PanelRig rig;
  rig.click("Method");
  EXPECT_TRUE(rig.ui.list_open);
  rig.session.select_body(0);
  press(GLFW_KEY_ESCAPE, false, rig.session, rig.ui);
  rig.press_escape();
  EXPECT_FALSE(rig.ui.list_open);
  EXPECT_TRUE(rig.session.selected_body());
  EXPECT_EQ(rig.session.world().method().key, collide::default_method);
  press(GLFW_KEY_ESCAPE, false, rig.session, rig.ui);
  EXPECT_FALSE(rig.session.selected_body());
}

TEST(Panel, WhatFindsNoRoomIsNamed) {
  PanelRig rig;
  rig.frames(2);
  ASSERT_TRUE(rig.ui.table);
  EXPECT_FALSE(rig.recorder.find("No room"));
  rig.resize(800, 500);
  EXPECT_TRUE(rig.recorder.find("No room")) << "for the hash table";
  rig.ui.table = false;
  rig.resize(800, 350);
  EXPECT_FALSE(rig.recorder.find("No room"));
  rig.session.compare.on = true;
  rig.frames(2);
  EXPECT_TRUE(rig.recorder.find("No room")) << "for the comparison";
  rig.resize(1280, 1150);
  EXPECT_FALSE(rig.recorder.find("No room"));
}

TEST(Panel, TheErrorWindowStandsBelowTheStatus) {
  PanelRig rig;
  rig.ui.sweep = true;
  for (const glm::ivec2 size : {glm::ivec2(800, 600), glm::ivec2(1280, 720)}) {
    rig.resize(size.x, size.y);
    for (const bool compare : {false, true}) {
      rig.session.compare.on = compare;
      rig.frames(3);
      float status_ends = 0;
      for (const char* label : {"Live recall", "Step light", "No room"})
        if (const Recorder::Widget* line = rig.recorder.find(label)) status_ends = std::max(status_ends, line->max.y);
      const float title = ImGui::GetFrameHeight() + ImGui::GetStyle().WindowPadding.y;
      EXPECT_GE(rig.widget("Sweep").min.y - title, status_ends) << size.x << ", compare: " << compare;
      const Recorder::Widget plot = rig.widget("Scatter");
      EXPECT_GE(plot.max.y - plot.min.y, 120) << size.x << ", compare: " << compare;
      EXPECT_LE(plot.max.y, rig.interface.scene_area().max.y);
      const bool has_room = size.y > 700;
      EXPECT_EQ(rig.recorder.find("Column Method") != nullptr, compare && has_room);
    }
  }
}

TEST(Panel, LegendsAreNoWiderThanTheirPlace) {
  for (const float scale : {1.0f, 2.0f}) {
    PanelRig rig(scale);
    for (const OverlayRow& row : overlay_table) rig.ui.overlays.*row.shown = true;
    rig.session.set_contact_surface(softbody::ContactSurface::surfaces);
    rig.session.set_ghost(IntegratorChoice{"semi-implicit-euler", 1234});
    rig.frames(3);
    const float display = 1280 * scale;
    ASSERT_LT(rig.interface.scene_area().max.x, display) << "there is no column";
    EXPECT_GE(std::ranges::count(rig.recorder.widgets, "Legend", &Recorder::Widget::label), 7);
    for (const Recorder::Widget& line : rig.recorder.widgets)
      if (line.label == "Legend") {
        EXPECT_LE(line.max.x, display - ImGui::GetStyle().WindowPadding.x);
      }
    rig.resize(static_cast<int>(600 * scale), static_cast<int>(900 * scale));
    ASSERT_EQ(rig.interface.scene_area().max.x, 600 * scale) << "there is a column";
    for (const Recorder::Widget& line : rig.recorder.widgets)
      if (line.label == "Legend") {
        EXPECT_LE(line.max.x, 600 * scale) << "over the scene";
      }
  }
}

TEST(Panel, TheTourFitsSmallWindows) {
  PanelRig rig;
  for (const glm::ivec2 size : {glm::ivec2(640, 480), glm::ivec2(500, 400), glm::ivec2(1280, 720)}) {
    rig.resize(size.x, size.y);
    rig.ui.tour.start(rig.session, rig.ui.overlays);
    rig.frames(3);
    for (const char* label : {"Back", "Next", "Close tour"}) {
      const Recorder::Widget button = rig.widget(label);
      EXPECT_LE(button.max.x, static_cast<float>(size.x)) << label;
      EXPECT_LE(button.max.y, static_cast<float>(size.y)) << label;
    }
    const SceneArea scene = rig.interface.scene_area();
    EXPECT_GT(scene.max.x - scene.min.x, 200);
    EXPECT_GT(scene.max.y - scene.min.y, 150);
    rig.ui.tour.close(rig.session, rig.ui.overlays);
  }
}

TEST(Panel, NothingCoversTheMiddleOfTheSceneWithAllShown) {
  for (const glm::ivec2 size : {glm::ivec2(1280, 720), glm::ivec2(1600, 1000)}) {
    PanelRig rig;
    for (const OverlayRow& row : overlay_table) rig.ui.overlays.*row.shown = true;
    rig.session.compare.on = true;
    rig.resize(size.x, size.y);
    const SceneArea scene = rig.interface.scene_area();
    const float width = scene.max.x - scene.min.x, height = scene.max.y - scene.min.y;
    EXPECT_GE(width, 0.5f * static_cast<float>(size.x));
    EXPECT_GE(height, 0.75f * static_cast<float>(size.y));
    for (const char* label : {"Buckets of the table", "Judged frame", "Drive Multi-Level SB"})
      ASSERT_TRUE(rig.recorder.find(label)) << label;
    for (const auto& [label, min, max, enabled] : rig.recorder.widgets) {
      const bool beside = max.x <= scene.min.x || min.x >= scene.max.x || min.y >= scene.max.y;
      const bool at_the_top = max.y <= scene.min.y + 0.25f * height;
      EXPECT_TRUE(beside || at_the_top) << label << " covers the scene";
    }
  }
}

TEST(Panel, NothingMovesWhileNumbersChange) {
  PanelRig rig;
  rig.frames(5);
  const auto before = rig.recorder.widgets;
  for (int i = 0; i < 90; ++i) {
    rig.frame();
    ASSERT_EQ(rig.recorder.widgets.size(), before.size());
    for (std::size_t w = 0; w < before.size(); ++w) {
      const auto &then = before[w], &now = rig.recorder.widgets[w];
      ASSERT_EQ(now.label, then.label);
      ASSERT_TRUE(now.min.x == then.min.x && now.min.y == then.min.y && now.max.x == then.max.x &&
                  now.max.y == then.max.y)
          << now.label << " moved";
    }
  }
  EXPECT_GT(rig.session.world().frame(), 90);
}

TEST(Panel, FoldsItsSections) {
  PanelRig rig;
  ASSERT_TRUE(rig.recorder.find("Tolerance"));
  rig.click("Detection");
  EXPECT_FALSE(rig.recorder.find("Tolerance"));
  EXPECT_TRUE(rig.recorder.find("Coverage"));  // the light stays
}

TEST(Panel, HidesAndShowsWithEverythingElseInPlace) {
  PanelRig rig;
  rig.ui.panel = false;
  rig.frames(2);
  EXPECT_FALSE(rig.recorder.find("Pause"));
  EXPECT_TRUE(rig.recorder.find("Coverage"));
  EXPECT_TRUE(rig.recorder.find("Live recall"));
  EXPECT_LT(rig.widget("Coverage").min.x, 100);
}

TEST(Panel, IsTwiceAsLargeOnAHighDensityScreen) {
  const ImVec2 one = PanelRig().widget("Pause").max;
  const ImVec2 two = PanelRig(2).widget("Pause").max;
  EXPECT_NEAR(two.x, 2 * one.x, 8);
  EXPECT_NEAR(two.y, 2 * one.y, 8);
}

TEST(Panel, TheHelpOpensAndCloses) {
  PanelRig rig;
  rig.click("?");
  rig.frames(2);
  ASSERT_TRUE(rig.ui.help);
  rig.click("Close");
  EXPECT_FALSE(rig.ui.help);
}

TEST(Panel, TheColumnsOfTheHelpStandApart) {
  for (const float scale : {1.0f, 2.0f}) {
    PanelRig rig(scale);
    rig.ui.help = true;
    rig.frames(3);
    float first_ends = 0;
    for (const Shortcut& shortcut : shortcuts())
      first_ends = std::max(first_ends, rig.widget(fmt::format("Help {}", shortcut.what)).max.x);
    const float keys =
        rig.widget(fmt::format("Help {}", shortcuts()[0].what)).min.x;  // a key stands as far left of what it does
    const float width = keys - rig.widget("Close").min.x;
    for (const OverlayRow& row : overlay_table)
      EXPECT_GT(rig.widget(fmt::format("Help {}", row.label)).min.x - width, first_ends) << row.label;
  }
}

}  // namespace
}  // namespace app
