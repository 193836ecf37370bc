// Where the parts of the user interface stand, in small and large windows.

#include <algorithm>
#include <map>

#include <fmt/core.h>

#include "app/ui/panel/panel.h"
#include "app/ui/state/shortcuts.h"
#include "tests/app/keys.h"
#include "tests/app/panel_rig.h"

#include <GLFW/glfw3.h>

namespace app {
namespace THIS_FILE {

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
      EXPECT_GE(plot.max.y - plot.min.y, size.y > 600 ? 180 : 130);
      for (const ui::WidgetRecorder::Widget& entry : rig.recorder.widgets) {
        if (!entry.label.starts_with("Legend ")) continue;
        EXPECT_LE(entry.max.x, static_cast<float>(size.x)) << entry.label;
        EXPECT_LE(entry.max.y, plot.min.y) << entry.label;
      }
      EXPECT_LE(rig.area("Sweep footing").max.y, static_cast<float>(size.y));
    }
}

ui::ScreenRect united(const ui::ScreenRect& a, const ui::ScreenRect& b) {
  return {{std::min(a.min.x, b.min.x), std::min(a.min.y, b.min.y)},
          {std::max(a.max.x, b.max.x), std::max(a.max.y, b.max.y)}};
}
ui::ScreenRect common(const ui::ScreenRect& a, const ui::ScreenRect& b) {
  return {{std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y)},
          {std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y)}};
}

/// Expects of what ImGui drew last that no letter is cut at a side of its window, nor, where nothing scrolls, at its
/// upper or lower end; and that neither a window nor the scene lies under another window.
void expect_whole_texts_apart(const ui::ScreenRect& scene) {
  std::map<std::string, ui::ScreenRect> windows{{"scene", scene}};
  const ImDrawData& drawn = *ImGui::GetDrawData();
  for (int i = 0; i < drawn.CmdListsCount; ++i) {
    const ImDrawList& list = *drawn.CmdLists[i];
    const std::string owner(list._OwnerName), window = owner.substr(0, owner.find('/'));
    if (window == "##Background") continue;  // the line between two worlds
    for (const ImDrawCmd& cmd : list.CmdBuffer) {
      const ui::ScreenRect clip{{cmd.ClipRect.x, cmd.ClipRect.y}, {cmd.ClipRect.z, cmd.ClipRect.w}};
      for (unsigned k = 0; k < cmd.ElemCount; k += 3) {
        const ImDrawVert
            *a = &list.VtxBuffer[static_cast<int>(cmd.VtxOffset) + list.IdxBuffer[int(cmd.IdxOffset + k)]],
            *c = &list.VtxBuffer[static_cast<int>(cmd.VtxOffset) + list.IdxBuffer[int(cmd.IdxOffset + k + 2)]];
        const ui::ScreenRect at = united({a->pos, a->pos}, {c->pos, c->pos});
        const ui::ScreenRect seen = common(at, clip);
        if (seen.max.x <= seen.min.x || seen.max.y <= seen.min.y) continue;
        const auto known = windows.try_emplace(window, seen).first;
        known->second = united(known->second, seen);
        if (a->uv.x == c->uv.x || a->uv.y == c->uv.y) continue;  // no letter
        EXPECT_TRUE(at.min.x >= clip.min.x - 1 && at.max.x <= clip.max.x + 1) << "a letter is cut in " << owner;
        const bool scrolls = window == "Panel" || window == "Sidebar" || owner != window;
        EXPECT_TRUE(scrolls || (at.min.y >= clip.min.y - 1 && at.max.y <= clip.max.y + 1))
            << "a line is cut in " << owner;
      }
    }
  }
  for (const auto& [one, its] : windows)
    for (const auto& [other, area] : windows)
      EXPECT_FALSE(one < other && overlap(its, area)) << one << " and " << other << " overlap";
}

TEST(Layout, CutsNoTextAndLaysNoPartOverAnother) {
  struct State {
    const char* name;
    void (*set)(PanelRig& rig);
  };
  const auto all_overlays = [](PanelRig& rig) {
    for (const render::OverlayRow& row : render::overlay_table) rig.ui.overlays.*row.shown = true;
    rig.ui.overlays.true_surfaces = false;  // has a sidebar
  };
  const State states[]{
      {"as it opens", [](PanelRig&) {}},
      {"explained", [](PanelRig& rig) { rig.ui.coverage_explained = true; }},
      {"all overlays", all_overlays},
      {"a bucket and true surfaces",
       [](PanelRig& rig) {
         rig.ui.overlays.true_surfaces = rig.ui.hash_table = true;
         rig.change([](softbody::Scene& scene) { scene.collision.buckets = 7; });
         rig.session.inspector.select_bucket(3);
       }},
      {"without the panel", [](PanelRig& rig) { rig.ui.panel = false; }},
      {"messages",
       [](PanelRig& rig) {
         rig.session.simulation.notice.set(
             "a tolerance of 0.123456 m lets vertices slip through faces, because they "
             "are 0.25 m apart; choose one of 0.176 m at least");
         rig.session.import.drop({"/nowhere/a-file-that-is-not-there.obj"});
       }},
      {"the tour", [](PanelRig& rig) { rig.ui.tour.toggle(rig.session, rig.ui.overlays); }},
      {"the sweep", [](PanelRig& rig) { rig.ui.lower = ui::LowerView::sweep; }},
      {"two worlds, contact of surfaces",
       [](PanelRig& rig) {
         rig.ui.overlays.surface_contacts = rig.ui.overlays.contacts = true;
         rig.change([](softbody::Scene& scene) { scene.contact_surface = softbody::ContactSurface::surfaces; });
         toggle_beside(rig.session.simulation);
       }},
  };
  for (const auto& [width, height, scale] :
       {std::tuple(800, 600, 1.0f), {1280, 720, 1.0f}, {1600, 1000, 1.0f}, {2560, 1440, 2.0f}}) {
    for (const State& state : states) {
      SCOPED_TRACE(fmt::format("{} at {} x {}", state.name, width, height));
      PanelRig rig(scale);
      rig.ui.story = true;
      rig.ui.hash_table = false;
      rig.session.settings.set_method(collide::paper_method);
      rig.change([](softbody::Scene& scene) {
        scene.look_at = "Two bodies in contact, in the air above a solid sphere and the ground, which fall apart.";
        scene.collision.cell_size = glm::vec3(0.13f);
      });
      state.set(rig);
      rig.resize(width, height);
      rig.frames(2);
      const ui::ScreenRect scene = rig.interface.scene_area();
      expect_whole_texts_apart(scene);
      EXPECT_TRUE(rig.ui.tour.open() || scene.max.y - scene.min.y >= 200 * scale);
    }
  }
}

TEST(Layout, ShowsTheSentenceOfTheSceneBeforeItsCaptions) {
  softbody::Scene scene = touching_pair();
  scene.look_at = "Watch them.";
  scene.captions = {{0, "They are there"}};
  PanelRig rig(1, scene);
  const auto width = [&] { return rig.widget("Scene sentence").max.x - rig.widget("Scene sentence").min.x; };
  EXPECT_FLOAT_EQ(width(), ImGui::CalcTextSize("Watch them.").x);
  rig.session.simulation.notice.tell("something");
  rig.frames(2);
  EXPECT_FALSE(rig.shows("Scene sentence")) << "a message stands in its place";
  run(rig.session, 310);
  rig.frames(2);
  EXPECT_FLOAT_EQ(width(), ImGui::CalcTextSize("They are there").x);
}

TEST(Wrapped, BreaksLinesAtSpacesAndNotBeforeAUnit) {
  const PanelRig rig;
  ImGui::NewFrame();
  const std::string text = "Exact: finds all vertex pairs closer than 0.03 m, or 1,234.5 mm";
  for (float width = 20; width < 600; width += 7) {
    const std::string lines = ui::wrapped(text, width);
    std::string joined = lines;
    std::ranges::replace(joined, '\n', ' ');
    EXPECT_EQ(joined, text);
    EXPECT_EQ(lines.find("\nm"), std::string::npos) << lines;
    if (width > 150) {
      EXPECT_LE(ImGui::CalcTextSize(lines.c_str()).x, width) << lines;
    }
  }
  EXPECT_EQ(ui::wrapped(text, 600), text);
  ImGui::EndFrame();
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

TEST(Layout, LeavesTheMiddleOfTheSceneFreeWithAllPartsShown) {
  for (const glm::ivec2 size : {glm::ivec2(1280, 720), glm::ivec2(1600, 1000)}) {
    PanelRig rig;
    for (const render::OverlayRow& row : render::overlay_table) rig.ui.overlays.*row.shown = true;
    rig.ui.lower = ui::LowerView::comparison;
    rig.resize(size.x, size.y);
    const ui::ScreenRect scene = rig.interface.scene_area();
    const float width = scene.max.x - scene.min.x, height = scene.max.y - scene.min.y;
    EXPECT_GE(width, 0.5f * static_cast<float>(size.x));
    EXPECT_GE(height, 0.55f * static_cast<float>(size.y));
    for (const char* label : {"Buckets of the table", "Checked frame", "Drive Multi-Level SB"})
      ASSERT_TRUE(rig.recorder.find(label)) << label;
    for (const auto& [label, min, max, enabled] : rig.recorder.widgets) {
      EXPECT_FALSE(overlap({min, max}, scene)) << label << " covers the scene";
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
