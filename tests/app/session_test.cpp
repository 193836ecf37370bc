#include "app/session/session.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/app/scenes.h"

namespace app {
namespace THIS_FILE {

/// A body that lies on the ground from the start.
softbody::Scene lone_body() {
  softbody::Scene scene = touching_pair();
  scene.bodies.resize(1);
  scene.bodies[0].position = {5, 0.55, 0};
  scene.captions = {{2, "second"}};
  return scene;
}

TEST(Session, StandsStillOnceAllHasBeenAtRestForAsLongAsCurvesLast) {
  Session session(lone_body(), {}, 1);
  int rested = 0;
  for (int i = 0; i < 5000 && !session.simulation.stands_still(); ++i) {
    session.advance(tick);
    rested = session.world().all_at_rest() ? rested + 1 : 0;
  }
  ASSERT_TRUE(session.simulation.stands_still());
  EXPECT_NEAR(rested, int{TimeSeries::capacity}, 2);
  const int frame = session.world().frame();
  run(session, 10);
  EXPECT_EQ(session.world().frame(), frame) << "its time stands still";
  session.simulation.change_scene("Settings", [](softbody::Scene& s) { ++s.collision.levels; });
  EXPECT_FALSE(session.simulation.stands_still()) << "curves show the change";
  session.advance(tick);
  EXPECT_EQ(session.world().frame(), frame + 1);
  for (int i = 0; i < 5000 && !session.simulation.stands_still(); ++i) session.advance(tick);
  ASSERT_TRUE(session.simulation.stands_still());
  session.bodies.drop();
  EXPECT_FALSE(session.simulation.stands_still());
}

TEST(Session, GoesOnAtRestUntilItsLastSentence) {
  softbody::Scene scene = lone_body();
  constexpr int last = 3000;
  scene.captions.push_back({last, "the end"});
  Session session(std::move(scene), {}, 1);
  while (session.world().frame() < last) {
    ASSERT_FALSE(session.simulation.stands_still());
    session.advance(tick);
  }
  EXPECT_EQ(session.simulation.caption(), "the end");
  EXPECT_TRUE(session.world().all_at_rest());
  EXPECT_TRUE(session.simulation.stands_still());
}

TEST(Session, TakesNoWaitForASlowPicture) {
  Session session(touching_pair(), "", 1);
  run(session, 20);
  for (int i = 0; i < 40; ++i) session.advance(0.04, true);
  EXPECT_EQ(session.simulation.history.frame_ms.size(), 20u);
  EXPECT_LT(session.simulation.history.frame_ms.median(15), 17);
}

TEST(Session, SaysWhatTakesTheTimeBetweenPictures) {
  Session session(touching_pair(), {}, 1);
  session::StepHistory& history = session.simulation.history;
  const auto slowest = [&](float detect, float solve) {
    for (int i = 0; i < 20; ++i) {
      history.frame_ms.push(i, 100);  // six frames of the world
      history.detect_ms.push(i, detect);
      history.solve_ms.push(i, solve);
    }
    return std::string(session.slowest_part());
  };
  EXPECT_EQ(slowest(5, 1), "drawing") << "100 - 6 (5 + 1) ms";
  EXPECT_EQ(slowest(8, 1), "detection");
  EXPECT_EQ(slowest(1, 8), "solver");
}

TEST(Session, AgesItsNoticeWhileItWaits) {
  Session session(touching_pair(), {}, 1);
  session.simulation.clock.paused = true;
  session.simulation.notice.set("something");
  for (int i = 0; i < 79; ++i) session.let_pass(0.25);
  EXPECT_FALSE(session.simulation.notice.text().empty());
  for (int i = 0; i < 3; ++i) session.let_pass(0.25);
  EXPECT_TRUE(session.simulation.notice.text().empty()) << "after 20 s";
  EXPECT_EQ(session.world().frame(), 0);
}

TEST(Session, HasNewsWhenSomethingComesWithoutInput) {
  Session session(touching_pair(), {}, 1);
  session.simulation.clock.paused = true;
  ASSERT_TRUE(wait_until([&] { return session.let_pass(0), !session.awaits_answer(); }));
  const session::News before = session.news();
  session.let_pass(1);
  EXPECT_TRUE(before == session.news()) << "nothing has come";
  const std::vector<std::function<bool()>> comes{
      [&] { return session.simulation.clock.single_step(), session.advance(tick), true; },
      [&] { return session.let_pass(0), session.comparison.reports() > before.comparison; },
      [&] { return session.surfaces.on = true, session.let_pass(0), session.surfaces.reports() > 0; },
      [&] { return session.simulation.notice.tell("something"), true; },
      [&] { return session.let_pass(1), session.simulation.notice.text().empty(); },
      [&] { return session.sweep_worker.start(session.world(), compare::usual_methods()), true; },
      [&] { return session.sweep_worker.cancel(), session.let_pass(0), !session.sweep().running; }};
  for (std::size_t i = 0; i < comes.size(); ++i) {
    const session::News last = session.news();
    ASSERT_TRUE(wait_until(comes[i]));
    EXPECT_FALSE(last == session.news()) << i;
  }
}

TEST(Session, KeepsTheSelectedBucketInsideTheTable) {
  Session session(touching_pair(), {}, 1);
  session.inspector.select_bucket(900);
  EXPECT_EQ(session.inspector.selected_bucket(), 900u);
  session.inspector.select_bucket(1001);
  EXPECT_FALSE(session.inspector.selected_bucket());
  session.inspector.select_bucket(900);
  session.simulation.change_scene("Settings", [](softbody::Scene& s) { s.collision.buckets = 101; });
  EXPECT_FALSE(session.inspector.selected_bucket());
}

TEST(Session, ForgetsTheSelectionWithTheScene) {
  Session session(touching_pair(), {}, 1);
  session.bodies.select(1);
  session.inspector.select_bucket(9);
  run(session, 10);
  session.simulation.rewind_to(5);
  EXPECT_EQ(session.bodies.selected(), 1u) << "going back keeps it";
  EXPECT_EQ(session.inspector.selected_bucket(), 9u);
  session.simulation.reset();
  EXPECT_FALSE(session.bodies.selected());
  EXPECT_FALSE(session.inspector.selected_bucket());
}

TEST(Session, TellsTheComparisonOfChanges) {
  Session session(touching_pair(), {}, 1);
  session.simulation.clock.paused = true;
  const auto has_row = [&] {
    session.advance(tick);
    return session.comparison.driver_row() != nullptr;
  };
  ASSERT_TRUE(wait_until(has_row));
  session.settings.set_method("multi-level-sb");
  EXPECT_EQ(session.comparison.driver(), compare::method_index("multi-level-sb"));
  ASSERT_TRUE(wait_until(has_row));
  session.bodies.select(0);
  session.bodies.remove_selected();
  EXPECT_EQ(session.comparison.missed(), nullptr) << "of bodies that are gone";
  EXPECT_EQ(session.comparison.report().id, 0u);
  EXPECT_EQ(session.simulation.before_last_step().shown().x.size(), session.world().positions().x.size());
  session.simulation.reset();
  EXPECT_EQ(session.comparison.report().id, 0u);
}

}  // namespace THIS_FILE
}  // namespace app
