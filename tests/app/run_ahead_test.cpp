#include "app/session/run_ahead.h"

#include <gtest/gtest.h>

#include "app/session/session.h"
#include "tests/app/scenes.h"

namespace app {
namespace THIS_FILE {

TEST(RunAhead, StopsAtTheFrameThatItLooksFor) {
  const auto to_frame = [](int frame) {
    return [frame](const softbody::BodiesInMotion& world) { return world.frame() >= frame; };
  };
  Session session(touching_pair(), {}, 1);
  session.simulation.clock.slow_motion = true;
  session.run_ahead.start(to_frame(0), 1);
  EXPECT_FALSE(session.run_ahead.active()) << "this frame";
  EXPECT_TRUE(session.simulation.clock.paused);
  session.run_ahead.start(to_frame(40), 1);
  run(session, 100);
  EXPECT_FALSE(session.run_ahead.active());
  EXPECT_TRUE(session.simulation.clock.paused);
  EXPECT_EQ(session.simulation.world().frame(), 40);
  softbody::World world(touching_pair(), {});
  for (int frame = 0; frame < 40; ++frame) world.step();
  EXPECT_EQ(session.simulation.simulated()->state_hash(), world.state_hash());
  EXPECT_FALSE(session.simulation.stability().past().snapshots().empty());
}

TEST(RunAhead, EndsWhereItFindsNothing) {
  const auto never = [](const softbody::BodiesInMotion&) { return false; };
  Session session(touching_pair(), {}, 1);
  session.run_ahead.start(never, 0.5);
  run(session, 100);
  EXPECT_TRUE(session.simulation.clock.paused) << "out of time";
  EXPECT_NEAR(session.simulation.world().frame(), 30, 1);
  session.run_ahead.start(never, 0.5);
  session.simulation.clock.paused = true;
  EXPECT_FALSE(session.run_ahead.active()) << "paused";
  run(session, 1);
  session.simulation.clock.paused = false;
  run(session, 2);
  EXPECT_FALSE(session.run_ahead.active()) << "goes on as usual";
  EXPECT_NEAR(session.simulation.world().frame(), 32, 1);
  session.run_ahead.start(never, 0.5);
  session.simulation.reset();
  EXPECT_FALSE(session.run_ahead.active()) << "another world";
  EXPECT_TRUE(session.simulation.clock.paused);
}

}  // namespace THIS_FILE
}  // namespace app
