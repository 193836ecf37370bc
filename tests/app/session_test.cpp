#include "app/session/session.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "tests/app/scenes.h"

namespace app {
namespace {

Session make_session() { return Session(touching_pair(), {}, 1); }

TEST(Session, StepsInFixedFramesOfRealTime) {
  Session session = make_session();
  for (int i = 0; i < 10; ++i) session.advance(tick);
  EXPECT_EQ(session.world().frame(), 10);
  for (int i = 0; i < 20; ++i) session.advance(tick / 2);
  EXPECT_EQ(session.world().frame(), 20);
}

/// On two threads, and by the time that pictures take.
TEST(Session, ComesToTheBitToWhereTheWorldComesByItself) {
  softbody::World world(touching_pair(), {});
  Session session(touching_pair(), {}, 2);
  for (int frame = 0; frame < 120; ++frame) {
    world.step();
    session.advance(tick);
    ASSERT_EQ(session.world().state_hash(), world.state_hash()) << frame;
  }
}

TEST(Session, DropsTimeInsteadOfSpiralling) {
  Session session = make_session();
  session.advance(1000);
  const int first = session.world().frame();
  EXPECT_GE(first, 1);
  EXPECT_LE(first, Session::most_steps);
  EXPECT_LT(session.pace(), 1);
  session.advance(0);  // nothing is owed from before
  EXPECT_EQ(session.world().frame(), first);
  for (int i = 0; i < 60; ++i) session.advance(tick);
  EXPECT_EQ(session.world().frame(), first + 60);
  EXPECT_GT(session.pace(), 0.95);
}

TEST(Session, IgnoresTimeThatRunsBackwards) {
  Session session = make_session();
  session.advance(-1);
  EXPECT_EQ(session.world().frame(), 0);
}

TEST(Session, PausesAndStepsOnce) {
  Session session = make_session();
  session.paused = true;
  for (int i = 0; i < 10; ++i) session.advance(tick);
  EXPECT_EQ(session.world().frame(), 0);
  session.single_step();
  for (int i = 0; i < 10; ++i) session.advance(tick);
  EXPECT_EQ(session.world().frame(), 1);
  session.paused = false;
  session.single_step();
  EXPECT_TRUE(session.paused);
}

TEST(Session, RunsSlowlyByTheFactor) {
  Session session = make_session();
  session.slow_motion = true;
  session.slow_factor = 0.1;
  for (int i = 0; i < 100; ++i) session.advance(tick);
  EXPECT_EQ(session.world().frame(), 10);
}

TEST(Session, ShowsSlowMotionBetweenTwoSteps) {
  Session session = make_session();
  EXPECT_EQ(session.between(), 1.0f);
  session.slow_motion = true;
  session.slow_factor = 0.25;
  float last = -1;
  for (int i = 0; i < 3; ++i) {
    session.advance(tick);
    EXPECT_GT(session.between(), last);
    EXPECT_LT(session.between(), 1.0f);
    last = session.between();
  }
  const float height = session.world().positions().y[0];
  session.advance(tick);
  EXPECT_LT(session.between(), last);
  EXPECT_EQ(session.before_last_step().y[0], height);
  session.paused = true;
  EXPECT_EQ(session.between(), 1.0f);
}

TEST(Session, ResetKeepsTheSettingsAndRestartsTheWorld) {
  Session session = make_session();
  session.set_method("grid-hash");
  collide::Settings settings = session.world().collision();
  settings.buckets = 77;
  settings.cell_size = glm::vec3(0.25f);
  session.set_collision(settings, false);
  session.drop();
  for (int i = 0; i < 5; ++i) session.advance(tick);
  session.reset();
  EXPECT_EQ(session.world().frame(), 0);
  EXPECT_EQ(session.world().bodies().count(), 2u);
  EXPECT_EQ(session.world().method().key, "grid-hash");
  EXPECT_EQ(session.world().collision().buckets, 77u);
  EXPECT_EQ(session.world().collision().cell_size, glm::vec3(0.25f));
  session.restore_settings();
  EXPECT_EQ(session.world().method().key, collide::default_method);
  EXPECT_EQ(session.world().collision().buckets, 1001u);
  EXPECT_TRUE(session.world().uses_default_cell_size());
}

TEST(Session, DropsABodyAlsoWhereTheSceneDoesNotSayWhere) {
  Session session = make_session();
  session.drop();
  EXPECT_EQ(session.world().bodies().count(), 3u);
  softbody::Scene scene = touching_pair();
  scene.dropper.reset();
  Session bare(scene, {}, 1);
  EXPECT_TRUE(bare.can_drop());
  bare.drop();
  EXPECT_EQ(bare.world().bodies().count(), 3u);
  scene.bodies.clear();
  Session nothing(scene, {}, 1);
  EXPECT_FALSE(nothing.can_drop());
  nothing.drop();
  EXPECT_EQ(nothing.world().bodies().count(), 0u);
}

TEST(Session, ANoticeGoesWithTimeAndWhenItIsHeeded) {
  Session session = make_session();
  session.paused = true;
  session.remove_selected();
  ASSERT_FALSE(session.notice().empty()) << "nothing is selected";
  session.select_body(0);
  EXPECT_TRUE(session.notice().empty());
  session.select_body({});
  session.remove_selected();
  for (int i = 0; i < 30; ++i) session.advance(0.5);
  EXPECT_FALSE(session.notice().empty());
  session.remove_selected();  // the same words again
  for (int i = 0; i < 15; ++i) session.advance(0.5);
  EXPECT_TRUE(session.notice().empty());
}

TEST(Session, SaysTheCaptionOfTheMoment) {
  Session session = make_session();
  EXPECT_EQ(session.caption(), "");
  for (int i = 0; i < 4; ++i) session.advance(tick);
  EXPECT_EQ(session.caption(), "second");
  for (int i = 0; i < 4; ++i) session.advance(tick);
  EXPECT_EQ(session.caption(), "fifth");
}

TEST(Session, KeepsTheSceneWhenAnotherCannotBeLoaded) {
  Session session = make_session();
  session.choose_scene("no-such-scene.toml");
  EXPECT_NE(session.notice().find("no-such-scene"), std::string::npos);
  EXPECT_EQ(session.world().scene().key, "pair");
}

TEST(Session, ResetKeepsTheContactSurfaceAndTheScenesSettingsBringItBack) {
  Session session = make_session();
  const auto surface = [&] { return session.world().scene().contact_surface; };
  const auto revision = session.revision();
  session.set_contact_surface(softbody::ContactSurface::surfaces);
  EXPECT_NE(session.revision(), revision);
  session.advance(tick);
  session.reset();
  EXPECT_EQ(surface(), softbody::ContactSurface::surfaces);
  session.restore_settings();
  EXPECT_EQ(surface(), softbody::ContactSurface::vertices);
}

TEST(TimeSeries, KeepsTheLastValuesInOrder) {
  TimeSeries series;
  EXPECT_EQ(series.size(), 0u);
  for (std::size_t i = 0; i < TimeSeries::capacity + 5; ++i)
    series.push(static_cast<int>(2 * i), static_cast<float>(i));
  EXPECT_EQ(series.size(), TimeSeries::capacity);
  EXPECT_EQ(series[0], 5.0f);
  EXPECT_EQ(series.frame(0), 10);
  EXPECT_EQ(series[TimeSeries::capacity - 1], static_cast<float>(TimeSeries::capacity + 4));
  EXPECT_EQ(series.max(), static_cast<float>(TimeSeries::capacity + 4));
  EXPECT_EQ(series.median(3), static_cast<float>(TimeSeries::capacity + 3));
  EXPECT_EQ(TimeSeries().median(3), 0.0f);
}

}  // namespace
}  // namespace app
