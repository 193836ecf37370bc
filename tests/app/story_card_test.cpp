// The card on what the paper's method misses.

#include "tests/app/keys.h"
#include "tests/app/panel_rig.h"
#include "tests/app/recorded_bodies.h"

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

TEST(StoryCard, OpensTheTourByOneClick) {
  PanelRig rig;
  rig.ui.story = true;
  make_it_miss(rig);
  rig.frames(3);
  rig.click("Explain story");
  EXPECT_TRUE(rig.ui.tour.open());
  EXPECT_EQ(rig.ui.tour.step(), ui::miss_step);
}

TEST(StoryCard, SaysWhatMissesCostAndShowsItBesideFromTheStart) {
  PanelRig rig;
  rig.ui.story = true;
  ASSERT_TRUE(rig.frames_until([&] { return rig.session.price.price() != nullptr; }));
  const compare::Price& price = *rig.session.price.price();
  ASSERT_EQ(price.failure, "");
  const compare::HowSimulated second =
      compare::usual_second(rig.session.world(), rig.session.simulated()->integrator_choice());
  softbody::World alone(second.scene, {});
  compare::RunFigures figures;
  while (alone.frame() < compare::Price::frames) {
    alone.step();
    figures.add(alone);
  }
  const auto& [cell, run] = price.runs[compare::Price::small_cells];
  EXPECT_EQ(run.missed, figures.totals().missed);
  EXPECT_EQ(run.true_contacts, figures.totals().true_contacts);
  EXPECT_EQ(cell, second.scene.collision.cell_size->x);
  EXPECT_EQ(price.runs[compare::Price::exact].totals.missed, 0u);
  rig.frames(3);
  rig.click("See it beside");
  ASSERT_TRUE(rig.session.simulation.beside());
  EXPECT_LT(rig.session.world().frame(), 10);
  EXPECT_EQ(rig.session.simulation.world(session::Half::second).collision().cell_size,
            second.scene.collision.cell_size);
}

TEST(PriceMonitor, HasTheFiguresOfThePresentSettingsAndOfNoTrialThatWasCancelled) {
  Session session(touching_pair(), {}, 1);
  session.price.on = true;
  for (const int level : {3, 0, 3}) {
    session.simulation.change_scene("Subdivision", [level](softbody::Scene& s) { s.collision.levels = level; });
    session.advance(tick);
  }
  const auto known = [&] {
    session.advance(tick);
    return session.price.price() != nullptr;
  };
  ASSERT_TRUE(wait_until(known));
  for (const auto& run : session.price.price()->runs) EXPECT_EQ(run.totals.frames, compare::Price::frames);
  EXPECT_EQ(session.price.price()->runs[compare::Price::automatic_cells].cell,
            session.world().collision().cell_size->x);
  session.simulation.change_scene("Subdivision", [](softbody::Scene& s) { s.collision.levels = 0; });
  session.advance(tick);
  EXPECT_FALSE(session.price.price()) << "of other settings";
  ASSERT_TRUE(wait_until(known));
  const files::Opened played = opened(std::make_shared<RecordedBalls>(2));
  session.simulation.enter(session::show_in_window(played, 1), {played.scene, {}}, "choice of scene");
  session.advance(tick);
  EXPECT_FALSE(session.price.price()) << "nothing played has a price";
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
