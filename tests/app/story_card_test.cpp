// The card on what the paper's method misses.

#include "tests/app/keys.h"
#include "tests/app/panel_rig.h"

#include <GLFW/glfw3.h>

namespace app {
namespace THIS_FILE {

/// Makes cells so small that the corners of boxes skip some.
void make_it_miss(PanelRig& rig) {
  rig.session.simulation.clock.paused = true;
  rig.change([](softbody::Scene& scene) {
    scene.collision.cell_size = glm::vec3(0.13f);
    scene.collision.buckets = 1'000'003;
  });
}

TEST(StoryCard, CountsWhatThePapersMethodMissesBesideAnExactDriver) {
  PanelRig rig;
  rig.ui.story = true;
  make_it_miss(rig);
  const auto paper = compare::method_index(collide::paper_method);
  ASSERT_TRUE(rig.frames_until([&] { return rig.session.comparison.scored_row(paper) != nullptr; }));
  rig.frame();
  EXPECT_FALSE(rig.session.comparison.missed()->empty());
  EXPECT_EQ(rig.session.comparison.missed(), &rig.session.comparison.scored_row(paper)->missed);
  EXPECT_TRUE(rig.recorder.find("Story of Multi-Level SB"));
  EXPECT_TRUE(rig.recorder.find("Story of Multi-Level SB, exact"));
  rig.session.settings.set_method(collide::paper_method);
  ASSERT_TRUE(rig.frames_until([&] { return rig.shows("Story of Brute force"); }))
      << "the reference stands beside the paper's method when that drives";
}

TEST(StoryCard, KnowsThePapersMethodWhicheverMissesAreShown) {
  PanelRig rig;
  rig.ui.story = true;
  make_it_miss(rig);
  rig.session.comparison.choice.misses_of = compare::method_index("grid-hash");
  ASSERT_TRUE(rig.frames_until([&] { return rig.session.comparison.paper_row() != nullptr; }));
  EXPECT_FALSE(rig.session.comparison.paper_row()->missed.empty());
}

TEST(StoryCard, IsClosedByEscapeOnlyWhereItIsShown) {
  PanelRig rig;
  rig.ui.story = true;
  for (const ui::LowerView lower : {ui::LowerView::comparison, ui::LowerView::none}) {
    rig.ui.lower = lower;
    handle_key(GLFW_KEY_ESCAPE, false, rig.session, rig.ui);
    EXPECT_EQ(rig.ui.story, lower == ui::LowerView::comparison);
  }
}

TEST(StoryCard, IsNotShownAtTheNextStartOnceItWasClosed) {
  PanelRig rig;
  for (const bool shown : {false, true}) {
    rig.ui.story = shown;
    handle_key(GLFW_KEY_ESCAPE, false, rig.session, rig.ui);
    EXPECT_EQ(rig.ui.story_at_start, !shown);
  }
  handle_key('W', false, rig.session, rig.ui);
  EXPECT_TRUE(rig.ui.story && rig.ui.story_at_start);
}

TEST(StoryCard, OpensTheTourByOneClick) {
  PanelRig rig;
  rig.ui.story = true;
  make_it_miss(rig);
  rig.frames(3);
  rig.click("Explain story");
  EXPECT_TRUE(rig.ui.tour.open());
  EXPECT_EQ(rig.ui.tour.step(), ui::miss_step);
}

TEST(FloatingBox, IsMovedByTheMouseWithinTheScene) {
  PanelRig rig;
  rig.frames(3);
  const ui::WidgetRecorder::Widget before = rig.widget("Close lights");
  const auto drag = [&](float x, float y) {
    const ui::WidgetRecorder::Widget at = rig.widget("Live recall");
    rig.move(at.max.x - 4, at.max.y - 4);
    rig.press();
    rig.move(at.max.x - 4 + x, at.max.y - 4 + y);
    rig.release();
    rig.frames(2);
  };
  drag(60, 200);
  EXPECT_NEAR(rig.widget("Close lights").min.x, before.min.x + 60, 1.5f);
  EXPECT_NEAR(rig.widget("Close lights").min.y, before.min.y + 200, 1.5f);
  drag(4000, 4000);
  EXPECT_LE(rig.widget("Live recall").max.x, rig.interface.scene_area().max.x);
  EXPECT_LE(rig.widget("Live recall").max.y, rig.interface.scene_area().max.y);
  rig.resize(900, 600);
  EXPECT_LE(rig.widget("Live recall").max.y, rig.interface.scene_area().max.y);
}

TEST(TimeLine, GoesBackInTime) {
  PanelRig rig;
  rig.frames(60);
  ASSERT_GT(rig.session.world().frame(), 40);
  rig.drag("Time line", -2000);
  EXPECT_EQ(rig.session.world().frame(), 0);
  EXPECT_TRUE(rig.session.simulation.clock.paused);
  rig.drag("Time line", 2000);
  EXPECT_GT(rig.session.world().frame(), 40) << "what was is still there";
  rig.ui.panel = false;
  rig.frames(2);
  rig.click("Pause");
  EXPECT_FALSE(rig.session.simulation.clock.paused);
}

}  // namespace THIS_FILE
}  // namespace app
