#include "app/ui/panel/panel.h"
#include "tests/app/keys.h"
#include "tests/app/panel_rig.h"

#include <GLFW/glfw3.h>

namespace app {
namespace THIS_FILE {

TEST(Panel, SwitchesEveryOverlay) {
  PanelRig rig;
  for (const render::OverlayRow& row : render::overlay_table) {
    const bool before = rig.ui.overlays.*row.shown;
    rig.click(row.label);
    EXPECT_NE(rig.ui.overlays.*row.shown, before) << row.key;
    rig.frames(3);
    rig.click(row.label);
    EXPECT_EQ(rig.ui.overlays.*row.shown, before) << row.key;
  }
}

TEST(SurfaceView, ShowsItsFiguresAndKeepsEverythingInPlace) {
  PanelRig rig;
  EXPECT_FALSE(rig.recorder.find("Penetrating vertices"));
  rig.click("True surfaces");
  rig.move(800, 1100);  // nothing there has a tooltip
  const auto before = rig.recorder.widgets;
  ASSERT_TRUE(rig.frames_until([&] { return rig.session.surfaces.sums().steps >= 2; }));
  ASSERT_EQ(rig.recorder.widgets.size(), before.size());
  rig.expect_in_place(before, "Remark");  // whose sentence changes
  rig.click("True surfaces");
  EXPECT_FALSE(rig.recorder.find("Penetrating vertices"));
}

TEST(NumbersPanel, ShowsWhatTheExactMethodSkips) {
  PanelRig rig;
  rig.open("Numbers");
  for (const collide::SkipKind& kind : collide::skip_kinds)
    EXPECT_TRUE(rig.recorder.find("  " + std::string(kind.text))) << kind.key;
  rig.session.settings.set_method("grid-hash");
  rig.frames(2);
  EXPECT_FALSE(rig.recorder.find("  " + std::string(collide::skip_kinds[0].text)));
}

TEST(NumbersPanel, ShowsTheResolutionOnlyWhereItIsLower) {
  PanelRig rig;
  rig.open("Numbers");
  EXPECT_FALSE(rig.shows("Resolution"));
  rig.ui.render_scale = 0.8f;
  rig.frames(2);
  EXPECT_TRUE(rig.shows("Resolution"));
}

TEST(Panel, ShowsWhatIsNeededWithoutScrolling) {
  for (const glm::ivec2 size : {glm::ivec2(800, 600), glm::ivec2(1280, 720)})
    for (const collide::Method& method : collide::method_table()) {
      PanelRig rig;
      rig.session.settings.set_method(method.key);
      rig.resize(size.x, size.y);
      int controls = 0;
      for (const auto& [label, min, max, enabled] : rig.recorder.widgets) {
        if (max.x > ui::panel_width) continue;
        EXPECT_LE(max.y, static_cast<float>(size.y)) << label;
        controls += label != "Hashing of" && label != "Contacts now" && label != "More";
      }
      EXPECT_LE(controls, 26) << method.key;
      for (const char* label : {"Scene", "Tour", "Throw", "Method", "Tolerance", "Contact surface", "Buckets",
                                "Cell size", "True surfaces", "Hash table", "More"})
        EXPECT_TRUE(rig.shows(label)) << label;
    }
}

TEST(Panel, ShowsAndHidesEachPartByItsSwitchKeyAndCloseButton) {
  struct Part {
    const char *switched_by, *closed_by;
    int key;
    const char* shows;
  };
  for (const Part& part : {Part{"Methods side by side", "Close compare", 'V', "Drive Grid Hash"},
                           Part{"Error against run time", "Close sweep", 'E', "Sweep"},
                           Part{"What the paper's method misses", "Close story", 'W', "Story sentence"},
                           Part{"Status lights", "Close lights", 'L', "Coverage"},
                           Part{"Hash table", "Close Hash table", 'T', "Buckets of the table"},
                           Part{"Help", "Close", GLFW_KEY_F1, "Help Pause or resume"}}) {
    SCOPED_TRACE(part.shows);
    PanelRig rig;
    rig.open("Time and view");
    const auto press_key = [&] { handle_key(part.key, false, rig.session, rig.ui); };
    const auto expect = [&](bool shown) {
      rig.frames(2);
      EXPECT_EQ(rig.shows(part.shows), shown);
    };
    if (rig.shows(part.shows)) press_key();
    expect(false);
    rig.click(part.switched_by);
    expect(true);
    rig.click(part.closed_by);
    expect(false);
    press_key();
    expect(true);
    press_key();
    expect(false);
  }
}

TEST(Panel, PausesStepsResetsAndSlowsTheWorld) {
  PanelRig rig;
  rig.click("Pause");
  EXPECT_TRUE(rig.session.simulation.clock.paused);
  const int frame = rig.session.world().frame();
  rig.frames(10);
  EXPECT_EQ(rig.session.world().frame(), frame);
  rig.click("Step");
  EXPECT_EQ(rig.session.world().frame(), frame + 1);
  rig.click("Pause");
  EXPECT_FALSE(rig.session.simulation.clock.paused);
  rig.click("Reset");
  EXPECT_LT(rig.session.world().frame(), frame);
  rig.open("Time and view");
  rig.click("Slow motion");
  EXPECT_TRUE(rig.session.simulation.clock.slow_motion);
  rig.drag("Slow motion speed", -500);
  EXPECT_NEAR(rig.session.simulation.clock.slow_factor, session::SimulationClock::min_slow_factor, 1e-6);
  rig.drag("Slow motion speed", 500);
  EXPECT_NEAR(rig.session.simulation.clock.slow_factor, session::SimulationClock::max_slow_factor, 1e-6);
}

TEST(Panel, ClosesOnlyTheOpenListAtEscape) {
  PanelRig rig;
  rig.click("Method");
  EXPECT_TRUE(rig.ui.popup_open);
  rig.session.bodies.select(0);
  handle_key(GLFW_KEY_ESCAPE, false, rig.session, rig.ui);
  rig.press_escape();
  EXPECT_FALSE(rig.ui.popup_open);
  EXPECT_TRUE(rig.session.bodies.selected());
  EXPECT_EQ(rig.session.world().method().key, collide::default_method);
  handle_key(GLFW_KEY_ESCAPE, false, rig.session, rig.ui);
  EXPECT_FALSE(rig.session.bodies.selected());
}

TEST(Panel, KeepsEverythingInPlaceWhileNumbersChange) {
  PanelRig rig;
  rig.open("Numbers");
  rig.frames(5);
  const auto before = rig.recorder.widgets;
  for (int i = 0; i < 90; ++i) {
    rig.frame();
    ASSERT_EQ(rig.recorder.widgets.size(), before.size());
    rig.expect_in_place(before);
  }
  EXPECT_GT(rig.session.world().frame(), 90);
  const ImVec2 tolerance = rig.area("Tolerance").min;
  rig.session.bodies.select(0);
  rig.open("Bodies");
  EXPECT_TRUE(rig.shows("Selected body"));
  EXPECT_EQ(rig.area("Tolerance").min.y, tolerance.y);
}

TEST(Panel, FoldsItsSectionsAndRemembersThem) {
  PanelRig rig;
  EXPECT_FALSE(rig.shows("Files"));
  rig.click_each({"More", "Files"});
  EXPECT_TRUE(rig.shows("File to open"));
  EXPECT_TRUE(rig.ui.sections.at("More") && rig.ui.sections.at("Files"));
  rig.click("More");
  EXPECT_FALSE(rig.shows("File to open"));
  EXPECT_FALSE(rig.ui.sections.at("More"));
  EXPECT_FALSE(rig.shows("Solid"));
  rig.resize(1280, 400);
  rig.ui.show_solid(0);  // as by a click on it
  rig.frames(3);
  ASSERT_TRUE(rig.shows("Solid"));
  EXPECT_LT(rig.widget("Solid").max.y, 400) << "it is scrolled to";
}

TEST(Panel, SaysWhichStagesActAsForcesInXpbd) {
  PanelRig rig;
  rig.open("Stages of a step");
  EXPECT_FALSE(rig.recorder.find("contact-response"));
  rig.session.settings.set_integrator({"xpbd"});
  rig.frames(2);
  EXPECT_TRUE(rig.recorder.find("contact-response"));
  EXPECT_FALSE(rig.recorder.find("structural-springs"));
}

TEST(Panel, IsTwiceAsLargeOnAHighDensityScreen) {
  const ImVec2 one = PanelRig().widget("Reset").max;
  const ImVec2 two = PanelRig(2).widget("Reset").max;
  EXPECT_NEAR(two.x, 2 * one.x, 8);
  EXPECT_NEAR(two.y, 2 * one.y, 8);
}

}  // namespace THIS_FILE
}  // namespace app
