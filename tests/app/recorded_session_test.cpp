// The demo plays a recording: time, speed, errors, and that everything that looks at positions works on it.

#include <gtest/gtest.h>

#include <algorithm>

#include "app/session/session.h"
#include "tests/app/recorded_bodies.h"
#include "tests/app/scenes.h"

namespace app {
namespace THIS_FILE {

class RecordedSession : public testing::Test {
 protected:
  static constexpr int frames = 8;

  int frame() const { return session.world().frame(); }
  /// Advances the paused session until `done`; false if that takes too long.
  bool wait(auto done) {
    return wait_until([&] {
      session.advance(tick);
      return done();
    });
  }
  std::shared_ptr<RecordedBalls> balls = std::make_shared<RecordedBalls>(frames);
  Session session{opened(balls), {}, 1};
  session::Simulation& simulation = session.simulation;
};

TEST_F(RecordedSession, LoopsOrPausesAtTheEndAndBeginsAgain) {
  run(session, frames + 2);
  EXPECT_EQ(frame(), 2);
  simulation.loop = false;
  run(session, 2 * frames);
  EXPECT_EQ(frame(), frames - 1);
  EXPECT_TRUE(simulation.clock.paused);
  simulation.clock.paused = false;
  run(session, 1);
  EXPECT_EQ(frame(), 0);
}

TEST_F(RecordedSession, RunsAsFastAsItIsTold) {
  simulation.clock.speed = 2;
  run(session, 3);
  EXPECT_EQ(frame(), 6);
  simulation.rewind_to(0);
  simulation.clock.paused = false;
  simulation.clock.speed = 0.25;
  run(session, 6);
  EXPECT_EQ(frame(), 1);
  EXPECT_NEAR(between(simulation), 0.5, 0.01) << "pictures between two frames";
  simulation.clock.slow_motion = true;  // a tenth of that
  run(session, 20);
  EXPECT_EQ(frame(), 2);
}

TEST_F(RecordedSession, GoesToAnyFrameAndPausesThere) {
  simulation.rewind_to(5);
  EXPECT_EQ(frame(), 5);
  EXPECT_TRUE(simulation.clock.paused);
  EXPECT_TRUE(std::ranges::equal(simulation.before_last_step().shown().x, session.world().positions().x));
  simulation.clock.single_step();
  run(session, 1);
  EXPECT_EQ(frame(), 6);
  EXPECT_TRUE(simulation.clock.paused);
  simulation.rewind_to(1);
  EXPECT_EQ(frame(), 1);
}

TEST_F(RecordedSession, StaysAtTheLastGoodFrameAndGoesOnBehindABrokenOne) {
  std::ofstream(balls->file(3)) << "v 0 0 x\n";
  run(session, 10);
  EXPECT_EQ(frame(), 2);
  EXPECT_TRUE(simulation.clock.paused);
  EXPECT_TRUE(simulation.notice.is_error());
  EXPECT_NE(simulation.notice.text().find("ball 3.obj:1"), std::string::npos) << simulation.notice.text();
  EXPECT_EQ(session.world().detection().contacts, true_contacts(session.world()));
  simulation.clock.paused = false;
  run(session, 1);
  EXPECT_EQ(frame(), 4);
  simulation.rewind_to(3);
  EXPECT_EQ(frame(), 4);
  simulation.rewind_to(1);
  EXPECT_EQ(frame(), 1);
  EXPECT_FALSE(simulation.notice.is_error());
}

TEST_F(RecordedSession, ForgetsReportsOnBodiesThatAreGone) {
  simulation.rewind_to(frames - 1);
  session.bodies.select(RecordedBalls::all - 1);
  const std::uint64_t world = simulation.world_number();
  simulation.clock.paused = false;
  run(session, 1);
  ASSERT_EQ(session.world().bodies().count(), RecordedBalls::few);
  EXPECT_NE(simulation.world_number(), world);
  EXPECT_FALSE(session.bodies.selected());
  EXPECT_TRUE(std::ranges::equal(simulation.before_last_step().shown().x, session.world().positions().x))
      << "nothing moved from the last frame to the first";
}

TEST_F(RecordedSession, KeepsTheCurvesOfALoopInOrder) {
  run(session, 3 * frames + 3);
  const TimeSeries& contacts = simulation.history.contacts;
  ASSERT_EQ(contacts.size(), 4u);  // frames 0 .. 3 of this round
  for (std::size_t i = 0; i < contacts.size(); ++i) EXPECT_EQ(contacts.frame(i), int(i));
}

TEST_F(RecordedSession, ChecksItsSurfaces) {
  session.surfaces.on = true;
  simulation.rewind_to(6);
  ASSERT_TRUE(wait([&] { return session.surfaces.report().id == simulation.revision(); }));
  EXPECT_EQ(session.surfaces.report().failure, "");
  EXPECT_EQ(session.surfaces.report().figures.overlapping_pairs, 0u);
}

TEST_F(RecordedSession, IsResetAndComesBackByUndo) {
  session.settings.set_method("grid-hash");
  simulation.rewind_to(6);
  simulation.reset();
  EXPECT_EQ(frame(), 0);
  EXPECT_EQ(session.world().method().key, "grid-hash");
  undo(simulation);
  EXPECT_EQ(frame(), 6);
  EXPECT_EQ(session.world().detection().contacts, true_contacts(session.world()));
  const softbody::Scene pair = touching_pair();
  session.scenes.enter(session::make_window_world(pair, {}, 1), pair, "pair");
  EXPECT_TRUE(session.simulated());
  EXPECT_EQ(simulation.clock.speed, 1);
  undo(simulation);
  EXPECT_EQ(frame(), 6);
  EXPECT_FALSE(session.simulated());
}

TEST_F(RecordedSession, TakesBackASettingAndStaysAtItsFrame) {
  const std::string_view before = session.world().method().key;
  simulation.rewind_to(6);
  session.settings.set_method("grid-hash");
  EXPECT_EQ(session.world().detection().contacts, true_contacts(session.world()));
  EXPECT_EQ(session.inspector.shown_geometry().buckets, session.world().collision().buckets);
  simulation.rewind_to(7);
  undo(simulation);
  EXPECT_EQ(session.world().method().key, before);
  EXPECT_EQ(frame(), 7);
  EXPECT_EQ(session.world().detection().contacts, true_contacts(session.world()));
  redo(simulation);
  EXPECT_EQ(session.world().method().key, "grid-hash");
}

TEST_F(RecordedSession, EndsTheSecondWorldOfTheSceneBefore) {
  Session other(touching_pair(), {}, 1);
  toggle_beside(other.simulation);
  ASSERT_TRUE(other.simulation.beside());
  other.scenes.enter(session::show_in_window(opened(balls), 1), opened(balls).scene, "balls");
  EXPECT_FALSE(other.simulation.beside());
  other.advance(tick);
  EXPECT_EQ(other.world().frame(), 1);
}

TEST_F(RecordedSession, RefusesBodiesAndChangesNothing) {
  simulation.rewind_to(6);
  session.bodies.drop();
  session.bodies.throw_body({0, 0, 5}, {0, 0, 0});
  session.bodies.add(softbody::BodySource{}, softbody::Material{});
  EXPECT_TRUE(simulation.notice.is_error());
  EXPECT_NO_THROW(simulation.pull_to({0, 9, 0})) << "nothing is held";
  EXPECT_EQ(session.world().bodies().count(), RecordedBalls::all);
  simulation.clock.paused = false;
  run(session, 1);
  EXPECT_EQ(frame(), 7);
}

}  // namespace THIS_FILE
}  // namespace app
