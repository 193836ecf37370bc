#include <algorithm>
#include <chrono>
#include <cmath>

#include "app/ui/panel/panel.h"
#include "app/ui/shortcuts.h"
#include "tests/app/panel_rig.h"

#include <GLFW/glfw3.h>

namespace app {
namespace {

using namespace std::chrono_literals;

TEST(Panel, SwitchesEveryOverlay) {
  PanelRig rig;
  for (const OverlayRow& row : overlay_table) {
    const bool before = rig.ui.overlays.*row.shown;
    rig.click(row.label);
    EXPECT_NE(rig.ui.overlays.*row.shown, before) << row.key;
    rig.frames(3);
    rig.click(row.label);
    EXPECT_EQ(rig.ui.overlays.*row.shown, before) << row.key;
  }
  rig.click("Hash table");
  EXPECT_FALSE(rig.ui.table);
}

TEST(Panel, ChoosesEveryMethodWhileRunning) {
  PanelRig rig;
  for (const collide::Method& method : collide::method_table()) {
    rig.click("Method");
    rig.click(method.name);
    EXPECT_EQ(rig.session.world().method().key, method.key);
    rig.frames(5);
    EXPECT_TRUE(rig.session.notice().empty()) << rig.session.notice();
  }
}

TEST(Panel, ChoosesEveryContactSurface) {
  PanelRig rig;
  const std::vector order{softbody::ContactSurface::surfaces, softbody::ContactSurface::vertices};
  for (const softbody::ContactSurface surface : order) {
    const auto& all = softbody::contact_surfaces;
    rig.click("Contact surface");
    rig.click(std::ranges::find(all, surface, &softbody::ContactSurfaceInfo::value)->name);
    EXPECT_EQ(rig.session.world().scene().contact_surface, surface);
    rig.frames(3);
    const bool counted = rig.recorder.find("surfaces, between bodies") != nullptr;
    EXPECT_EQ(counted, surface == softbody::ContactSurface::surfaces);
  }
}

TEST(Panel, TheFiguresOfTheTrueSurfacesComeAndMoveNothing) {
  PanelRig rig;
  EXPECT_FALSE(rig.recorder.find("Penetrating vertices"));
  rig.click("True surfaces");
  rig.move(800, 1100);  // nothing there has a tooltip
  const auto before = rig.recorder.widgets;
  for (const auto end = std::chrono::steady_clock::now() + 60s;
       rig.session.surfaces().sums().steps < 2 && std::chrono::steady_clock::now() < end;)
    rig.frame();
  ASSERT_GE(rig.session.surfaces().sums().steps, 2);
  ASSERT_EQ(rig.recorder.widgets.size(), before.size());
  for (const Recorder::Widget& was : before) {
    const Recorder::Widget is = rig.widget(was.label);
    EXPECT_TRUE(is.min.x == was.min.x && is.min.y == was.min.y && is.max.x == was.max.x && is.max.y == was.max.y)
        << was.label << " moved";
  }
  rig.click("True surfaces");
  EXPECT_FALSE(rig.recorder.find("Penetrating vertices"));
}

TEST(Panel, GoesBackByASlider) {
  PanelRig rig;
  rig.click("Detection");  // folded, so that all has room
  rig.click("Numbers");
  rig.click("Stability");
  rig.frames(60);
  const int frame = rig.session.world().frame();
  rig.drag("Go back to", -400);
  EXPECT_EQ(rig.session.world().frame(), 0);
  EXPECT_TRUE(rig.session.paused);
  rig.drag("Go back to", 400);
  EXPECT_GE(rig.session.world().frame(), frame);
  rig.click("Pause when a body explodes");
  EXPECT_FALSE(rig.session.pause_on_blow_up);
  EXPECT_TRUE(rig.recorder.find("Total"));
  EXPECT_TRUE(rig.recorder.find("Step light"));
  EXPECT_FALSE(rig.recorder.find("Alarm"));
}

TEST(Panel, NamesTheBodyThatExplodesAndRewinds) {
  PanelRig rig(1, doomed_pair());
  rig.frames(10);
  EXPECT_TRUE(rig.recorder.find("Alarm"));
  EXPECT_TRUE(rig.session.paused);
  rig.click("Rewind to the last good frame");
  EXPECT_FALSE(rig.recorder.find("Alarm"));
  EXPECT_TRUE(softbody::measure(rig.session.world()).finite);
}

TEST(Panel, EnablesOnlyWhatTheMethodUses) {
  PanelRig rig;
  rig.ui.table = false;
  for (const collide::Method& method : collide::method_table()) {
    rig.session.set_method(method.key);
    rig.frames(2);
    EXPECT_EQ(rig.widget("Subdivision level").enabled, method.uses_levels) << method.key;
    EXPECT_EQ(rig.widget("Buckets").enabled, method.uses_hash) << method.key;
    EXPECT_EQ(rig.widget("Auto").enabled, method.uses_hash) << method.key;
    for (const char* label : {"x prime", "y prime", "z prime", "Default primes"})
      EXPECT_EQ(rig.widget(label).enabled, method.uses_hash) << method.key;
    EXPECT_TRUE(rig.widget("Tolerance").enabled);
  }
}

TEST(Panel, EnablesWhatIsShownOrComparedThoughTheMethodHasNoUseForIt) {
  PanelRig rig;
  rig.ui.table = false;
  ASSERT_FALSE(rig.session.world().method().uses_hash);
  const auto enabled = [&] {
    rig.frames(2);
    return rig.widget("Buckets").enabled;
  };
  EXPECT_FALSE(enabled());
  for (bool* shown : {&rig.ui.table, &rig.ui.overlays.boxes, &rig.ui.overlays.cells, &rig.session.compare.on}) {
    *shown = true;
    EXPECT_TRUE(enabled());
    *shown = false;
    EXPECT_FALSE(enabled());
  }
}

TEST(Panel, ShowsWhatTheExactMethodSkips) {
  PanelRig rig;
  for (const collide::SkipKind& kind : collide::skip_kinds)
    EXPECT_TRUE(rig.recorder.find("  " + std::string(kind.text))) << kind.key;
  rig.session.set_method("grid-hash");
  rig.frames(2);
  EXPECT_FALSE(rig.recorder.find("  " + std::string(collide::skip_kinds[0].text)));
}

TEST(Panel, DrivesTime) {
  PanelRig rig;
  rig.click("Pause");
  EXPECT_TRUE(rig.session.paused);
  const int frame = rig.session.world().frame();
  rig.frames(10);
  EXPECT_EQ(rig.session.world().frame(), frame);
  rig.click("Step");
  EXPECT_EQ(rig.session.world().frame(), frame + 1);
  rig.click("Pause");
  EXPECT_FALSE(rig.session.paused);
  rig.click("Reset");
  EXPECT_LT(rig.session.world().frame(), frame);
  rig.click("Slow motion");
  EXPECT_TRUE(rig.session.slow_motion);
  rig.drag("Slow motion speed", -500);
  EXPECT_NEAR(rig.session.slow_factor, Session::slowest, 1e-6);
  rig.drag("Slow motion speed", 500);
  EXPECT_NEAR(rig.session.slow_factor, Session::fastest, 1e-6);
}

TEST(Panel, DropsABody) {
  PanelRig rig;
  const auto before = rig.session.world().bodies().count();
  rig.click("Drop");
  EXPECT_EQ(rig.session.world().bodies().count(), before + 1);
}

TEST(Panel, DragsEverySliderToItsEnds) {
  PanelRig rig;
  rig.session.set_method("multi-level-sb");
  rig.frames(2);
  const auto& settings = [&]() -> const collide::Settings& { return rig.session.world().collision(); };
  rig.drag("Subdivision level", -500);
  EXPECT_EQ(settings().levels, 0);
  rig.drag("Subdivision level", 500);
  EXPECT_EQ(settings().levels, collide::max_levels);
  rig.drag("Buckets", -500);
  EXPECT_EQ(settings().buckets, 1u);
  rig.drag("Buckets", 500);
  EXPECT_EQ(settings().buckets, collide::max_buckets);
  rig.drag("Buckets", -500);
  rig.click("Auto");
  EXPECT_FALSE(rig.session.world().uses_default_cell_size());
  rig.drag("Cell size", -500);
  EXPECT_NEAR(settings().cell_size.x, least_cell, 1e-5);
  rig.drag("Cell size", 500);
  EXPECT_NEAR(settings().cell_size.y, most_cell, 1e-5);
  rig.drag("Tolerance", -500);
  EXPECT_NEAR(settings().tolerance, tolerance_from, 1e-5);
  rig.drag("Tolerance", 500);
  EXPECT_NEAR(settings().tolerance, tolerance_to, 1e-5);
  rig.click("Self-collision");
  EXPECT_FALSE(settings().self_collision);
  rig.click("Scene's settings");
  EXPECT_EQ(rig.session.world().method().key, collide::default_method);
  EXPECT_EQ(settings().levels, 3);
  EXPECT_TRUE(rig.session.world().uses_default_cell_size());
}

TEST(Panel, SurvivesEveryMethodAtTheEndsOfEverySlider) {
  PanelRig rig;
  for (const collide::Method& method : collide::method_table()) {
    rig.session.set_method(method.key);
    for (const int levels : {0, collide::max_levels}) {
      for (const float cell : {least_cell, most_cell}) {
        for (const float tolerance : {tolerance_from, tolerance_to}) {
          collide::Settings settings = rig.session.world().collision();
          settings.levels = levels;
          settings.cell_size = glm::vec3(cell);
          settings.tolerance = tolerance;
          settings.buckets = 1;
          rig.session.set_collision(settings, false);
          rig.frames(2);
          EXPECT_FALSE(rig.session.paused) << method.key << ": " << rig.session.notice();
        }
      }
    }
  }
}

TEST(Panel, OffersThePapersBucketSizes) {
  PanelRig rig;
  for (const char* preset : {"101", "1,001", "1,009"}) {
    rig.click("Bucket presets");
    rig.click(preset);
    std::string digits(preset);
    std::erase(digits, ',');
    EXPECT_EQ(std::to_string(rig.session.world().collision().buckets), digits);
  }
}

TEST(Panel, TakesPrimesAndWarnsOfThoseThatSpoilTheHash) {
  PanelRig rig;
  const auto& primes = [&]() -> const auto& { return rig.session.world().collision().primes; };
  ASSERT_FALSE(rig.recorder.find("Primes warning"));
  rig.type("x prime", "7");
  rig.type("y prime", "1001");  // as many as there are buckets
  rig.type("z prime", "4294967295");
  EXPECT_EQ(primes(), (std::array<std::uint32_t, 3>{7, 1001, 4294967295}));
  EXPECT_TRUE(rig.recorder.find("Primes warning"));
  EXPECT_TRUE(rig.recorder.find("Buckets warning"));
  rig.session.set_method("bounding-box");
  rig.ui.table = false;
  rig.frames(2);
  EXPECT_FALSE(rig.recorder.find("Primes warning")) << "it hashes nothing";
  rig.session.set_method("grid-hash");
  rig.frames(2);
  rig.type("y prime", "0");
  EXPECT_EQ(primes()[1], 1u) << "the least there is";
  rig.click("Default primes");
  EXPECT_EQ(primes(), collide::default_primes);
  EXPECT_FALSE(rig.recorder.find("Primes warning"));
}

TEST(Panel, AClickOnABucketSelectsItAndAnotherReleasesIt) {
  PanelRig rig;
  const HashView& view = rig.interface.hash_view();
  const HashGrid& grid = view.grid();
  const std::uint32_t square = 345;
  const float x = view.grid_origin().x + (static_cast<float>(square % grid.columns) + 0.5f) * grid.side;
  const float y = view.grid_origin().y + (static_cast<float>(square / grid.columns) + 0.5f) * grid.side;
  rig.click_at(x, y);
  EXPECT_EQ(rig.session.selected_bucket(), 345u);
  rig.click_at(x, y);
  EXPECT_FALSE(rig.session.selected_bucket());
}

TEST(Panel, AClickOnManyBucketsSelectsTheFullest) {
  PanelRig rig;
  collide::Settings settings = rig.session.world().collision();
  settings.buckets = 1'000'003;
  rig.session.set_collision(settings, true);
  rig.session.paused = true;
  rig.frames(2);
  const HashView& view = rig.interface.hash_view();
  ASSERT_GT(view.grid().per_square, 1u);
  const auto loads = rig.session.debug().loads;
  const collide::BucketLoad fullest = *std::ranges::max_element(loads, {}, &collide::BucketLoad::load);
  const std::uint32_t square = fullest.bucket / view.grid().per_square;
  rig.click_at(view.grid_origin().x + (static_cast<float>(square % view.grid().columns) + 0.5f) * view.grid().side,
               view.grid_origin().y + (static_cast<float>(square / view.grid().columns) + 0.5f) * view.grid().side);
  ASSERT_TRUE(rig.session.selected_bucket());
  const auto selected = std::ranges::find(loads, *rig.session.selected_bucket(), &collide::BucketLoad::bucket);
  ASSERT_NE(selected, loads.end());
  EXPECT_EQ(selected->load, fullest.load);
}

TEST(Shortcuts, DoWhatTheHelpSays) {
  Session session(touching_pair(), {}, 1);
  UiState ui;
  const auto tap = [&](int key) { return press(key, false, session, ui); };
  EXPECT_TRUE(tap(' '));
  EXPECT_TRUE(session.paused);
  tap('N');
  session.advance(0);
  EXPECT_EQ(session.world().frame(), 1);
  tap('S');
  EXPECT_TRUE(session.slow_motion);
  tap('D');
  EXPECT_EQ(session.world().bodies().count(), 3u);
  tap('R');
  EXPECT_EQ(session.world().bodies().count(), 2u);
  tap(']');
  EXPECT_EQ(session.world().collision().levels, 4);
  for (int i = 0; i < 20; ++i) tap('[');
  EXPECT_EQ(session.world().collision().levels, 0);
  tap('F');
  EXPECT_EQ(session.world().scene().contact_surface, softbody::ContactSurface::surfaces);
  tap('F');
  EXPECT_EQ(session.world().scene().contact_surface, softbody::ContactSurface::vertices);
  tap('M');
  EXPECT_NE(session.world().method().key, collide::default_method);
  for (const OverlayRow& row : overlay_table) {
    const bool before = ui.overlays.*row.shown;
    EXPECT_TRUE(tap(row.shortcut));
    EXPECT_NE(ui.overlays.*row.shown, before);
  }
  tap('H');
  EXPECT_FALSE(ui.panel);
  tap('C');
  EXPECT_TRUE(ui.reset_camera);
  tap('?');
  EXPECT_TRUE(ui.help);
  tap('Q');
  EXPECT_TRUE(ui.quit);
  EXPECT_FALSE(tap('Z'));
  EXPECT_FALSE(tap('/')) << "of the same key as ? on some keyboards only";
}

TEST(Shortcuts, AreNoneWithAltOrSuper) {
  Session session(touching_pair(), {}, 1);
  UiState ui;
  for (const int mod : {GLFW_MOD_ALT, GLFW_MOD_SUPER}) {
    for (const Shortcut& shortcut : shortcuts())
      EXPECT_FALSE(press(shortcut.key, false, session, ui, shortcut.mods | mod)) << shortcut.label;
    for (const OverlayRow& row : overlay_table) EXPECT_FALSE(press(row.shortcut, false, session, ui, mod)) << row.label;
  }
  EXPECT_FALSE(ui.overlays.any());
}

TEST(Shortcuts, HeldKeysRepeatOnlyWhereThatHelps) {
  Session session(touching_pair(), {}, 1);
  UiState ui;
  EXPECT_FALSE(press(' ', true, session, ui));
  EXPECT_FALSE(press('1', true, session, ui));
  EXPECT_TRUE(press('N', true, session, ui));
}

}  // namespace
}  // namespace app
