// The demo plays a recording: time, speed, errors, and that everything that looks at positions works on it.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "app/session/live/sweep_worker.h"
#include "app/session/session.h"
#include "tests/app/recorded_bodies.h"
#include "tests/app/scenes.h"

namespace app {
namespace THIS_FILE {

using namespace std::chrono_literals;
class RecordedSession : public testing::Test {
 protected:
  static constexpr int frames = 8;

  void advance(int ticks) {
    for (int i = 0; i < ticks; ++i) session.advance(tick);
  }
  int frame() const { return session.world().frame(); }
  /// Advances the paused session until `done`; false if that takes too long.
  bool wait(auto done) {
    for (const auto end = std::chrono::steady_clock::now() + 60s; std::chrono::steady_clock::now() < end;) {
      session.advance(tick);
      if (done()) return true;
      std::this_thread::sleep_for(1ms);
    }
    return false;
  }
  std::vector<collide::Contact> true_contacts() const {
    collide::Workers alone(1);
    collide::Result result;
    collide::find_method("brute-force")
        ->make()
        ->detect(session.world().positions(), session.world().collision(), alone, result);
    return result.contacts;
  }

  std::shared_ptr<RecordedBalls> balls = std::make_shared<RecordedBalls>(frames);
  Session session{opened(balls), {}, 1};
  session::Simulation& simulation = session.simulation;
};

TEST_F(RecordedSession, LoopsOrPausesAtTheEndAndBeginsAgain) {
  advance(frames + 2);
  EXPECT_EQ(frame(), 2);
  simulation.loop = false;
  advance(2 * frames);
  EXPECT_EQ(frame(), frames - 1);
  EXPECT_TRUE(simulation.clock.paused);
  simulation.clock.paused = false;
  advance(1);
  EXPECT_EQ(frame(), 0);
}

TEST_F(RecordedSession, RunsAsFastAsItIsTold) {
  simulation.clock.speed = 2;
  advance(3);
  EXPECT_EQ(frame(), 6);
  simulation.rewind_to(0);
  simulation.clock.paused = false;
  simulation.clock.speed = 0.25;
  advance(6);
  EXPECT_EQ(frame(), 1);
  EXPECT_NEAR(simulation.between(), 0.5, 0.01) << "pictures between two frames";
  simulation.clock.slow_motion = true;  // a tenth of that
  advance(20);
  EXPECT_EQ(frame(), 2);
}

TEST_F(RecordedSession, GoesToAnyFrameAndPausesThere) {
  simulation.rewind_to(5);
  EXPECT_EQ(frame(), 5);
  EXPECT_TRUE(simulation.clock.paused);
  EXPECT_TRUE(std::ranges::equal(simulation.before_last_step().shown().x, session.world().positions().x));
  simulation.clock.single_step();
  advance(1);
  EXPECT_EQ(frame(), 6);
  EXPECT_TRUE(simulation.clock.paused);
  simulation.rewind_to(1);
  EXPECT_EQ(frame(), 1);
}

TEST_F(RecordedSession, StaysAtTheLastGoodFrameAndGoesOnBehindABrokenOne) {
  balls->broken = 3;
  advance(10);
  EXPECT_EQ(frame(), 2);
  EXPECT_TRUE(simulation.clock.paused);
  EXPECT_TRUE(simulation.notice.is_error());
  EXPECT_EQ(simulation.notice.text(), "frame 3 is broken");
  EXPECT_EQ(session.world().detection().contacts, true_contacts());
  simulation.rewind_to(3);
  EXPECT_EQ(frame(), 2);
  simulation.rewind_to(4);
  EXPECT_EQ(frame(), 4);
  EXPECT_FALSE(simulation.notice.is_error());
}

TEST_F(RecordedSession, ForgetsReportsOnBodiesThatAreGone) {
  simulation.rewind_to(frames - 1);
  session.bodies.select(RecordedBalls::all - 1);
  const std::uint64_t world = simulation.world_number();
  simulation.clock.paused = false;
  advance(1);
  ASSERT_EQ(session.world().bodies().count(), RecordedBalls::few);
  EXPECT_NE(simulation.world_number(), world);
  EXPECT_FALSE(session.bodies.selected());
  EXPECT_TRUE(std::ranges::equal(simulation.before_last_step().shown().x, session.world().positions().x))
      << "nothing moved from the last frame to the first";
}

TEST_F(RecordedSession, ComparesEveryFrameWithBruteForce) {
  session.comparison.choice.on = true;
  bool touched = false;
  for (int number = 0; number < frames; ++number) {
    simulation.rewind_to(number);
    ASSERT_TRUE(wait([&] { return session.comparison.report().id == simulation.revision(); })) << number;
    const compare::CompareReport& report = session.comparison.report();
    EXPECT_EQ(report.frame, number);
    EXPECT_EQ(report.true_contacts, true_contacts().size());
    for (std::size_t method = 0; method < report.rows.size(); ++method) {
      if (collide::method_table()[method].exact) {
        EXPECT_EQ(report.rows[method].recall, 1.0) << method;
      }
    }
    touched = touched || report.true_contacts > 0;
  }
  EXPECT_TRUE(touched);
}

TEST_F(RecordedSession, KeepsTheCurvesOfALoopInOrder) {
  advance(3 * frames + 3);
  const TimeSeries& contacts = simulation.history.contacts;
  ASSERT_EQ(contacts.size(), 4u);  // frames 0 .. 3 of this round
  for (std::size_t i = 0; i < contacts.size(); ++i) EXPECT_EQ(contacts.frame(i), int(i));
}

TEST_F(RecordedSession, ShowsTheHashTableOfTheFrame) {
  simulation.rewind_to(6);
  EXPECT_EQ(session.inspector.shown_geometry().buckets, session.world().collision().buckets);
  EXPECT_FALSE(session.inspector.shown_geometry().boxes.empty());
  session.settings.set_method("grid-hash");
  EXPECT_EQ(session.world().method().key, "grid-hash");
  EXPECT_EQ(session.world().detection().contacts, true_contacts());
}

TEST_F(RecordedSession, ChecksItsSurfaces) {
  session.surfaces.on = true;
  simulation.rewind_to(6);
  ASSERT_TRUE(wait([&] { return session.surfaces.report().id == simulation.revision(); }));
  EXPECT_EQ(session.surfaces.report().failure, "");
  EXPECT_EQ(session.surfaces.report().figures.overlapping_pairs, 0u);
}

TEST_F(RecordedSession, IsSwept) {
  simulation.rewind_to(6);
  session::SweepWorker worker(compare::SweepLimits{.repetitions = 1});
  worker.start(session.world(), compare::all_methods());
  session::SweepState state;
  ASSERT_TRUE(wait([&] {
    if (auto news = worker.take()) state = *news;
    return state.frame == 6 && !state.running;
  }));
  EXPECT_EQ(state.stop_reason, "");
  EXPECT_EQ(state.report.true_contacts, true_contacts().size());
  const auto in_use = [&](const compare::SweepRow& row) {
    return row.configuration.settings == session.world().collision();
  };
  EXPECT_TRUE(std::ranges::any_of(state.report.rows, in_use)) << "the automatic cell size is the world's";
}

TEST_F(RecordedSession, RunsAheadToAFrame) {
  session.run_ahead.start([](const softbody::BodiesInMotion& world) { return world.frame() == 5; }, 20);
  advance(20);
  EXPECT_EQ(frame(), 5);
  EXPECT_TRUE(simulation.clock.paused);
}

TEST_F(RecordedSession, IsResetAndComesBackByUndo) {
  session.settings.set_method("grid-hash");
  simulation.rewind_to(6);
  simulation.reset();
  EXPECT_EQ(frame(), 0);
  EXPECT_EQ(session.world().method().key, "grid-hash");
  simulation.undo();
  EXPECT_EQ(frame(), 6);
  EXPECT_EQ(session.world().detection().contacts, true_contacts());
  const softbody::Scene pair = touching_pair();
  session.scenes.enter(session::make_window_world(pair, {}, 1), pair, "pair");
  EXPECT_TRUE(session.simulated());
  EXPECT_EQ(balls->releases, 1) << "undo keeps the recording, but not what it has read";
  EXPECT_EQ(simulation.clock.speed, 1);
  simulation.undo();
  EXPECT_EQ(frame(), 6);
  EXPECT_FALSE(session.simulated());
}

TEST_F(RecordedSession, TakesBackASettingAndStaysAtItsFrame) {
  const std::string_view before = session.world().method().key;
  simulation.rewind_to(6);
  session.settings.set_method("grid-hash");
  simulation.rewind_to(7);
  simulation.undo();
  EXPECT_EQ(session.world().method().key, before);
  EXPECT_EQ(frame(), 7);
  EXPECT_EQ(session.world().detection().contacts, true_contacts());
  simulation.redo();
  EXPECT_EQ(session.world().method().key, "grid-hash");
}

TEST_F(RecordedSession, EndsTheGhostOfTheSceneBefore) {
  Session other(touching_pair(), {}, 1);
  other.choose_ghost(softbody::IntegratorChoice{});
  ASSERT_TRUE(other.ghost().world());
  other.scenes.enter(session::show_in_window(opened(balls), 1), opened(balls).scene, "balls");
  EXPECT_FALSE(other.ghost().world());
  other.advance(tick);
  EXPECT_EQ(other.world().frame(), 1);
}

TEST_F(RecordedSession, RefusesBodiesAndChangesNothing) {
  simulation.rewind_to(6);
  session.bodies.drop();
  session.bodies.throw_body({0, 0, 5}, {0, 0, 0});
  session.bodies.add(softbody::BodySource{}, softbody::Material{});
  EXPECT_TRUE(simulation.notice.is_error());
  EXPECT_EQ(session.world().bodies().count(), RecordedBalls::all);
  simulation.clock.paused = false;
  advance(1);
  EXPECT_EQ(frame(), 7);
}

}  // namespace THIS_FILE
}  // namespace app
