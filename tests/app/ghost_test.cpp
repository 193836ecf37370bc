#include "app/session/ghost.h"

#include <gtest/gtest.h>

#include "engine/resources.h"
#include "softbody/prototype.h"
#include "tests/app/hands.h"
#include "tests/app/panel_rig.h"

namespace app {
namespace {

const softbody::IntegratorChoice rk4{"rk4", 8};

void go_on(Session& session, int frames) {
  for (int i = 0; i < frames; ++i) session.advance(tick);
}

TEST(Ghost, OfTheSameIntegratorIsTheSameToTheBit) {
  Session session(touching_pair(), {}, 1);
  session.set_integrator("semi-implicit-euler", std::nullopt);
  go_on(session, 20);
  session.set_ghost(softbody::IntegratorChoice{"semi-implicit-euler", std::nullopt});
  go_on(session, 40);
  EXPECT_EQ(session.ghost()->distance(session.world()), 0);
  EXPECT_EQ(session.ghost()->world().state_hash(), session.world().state_hash());
  EXPECT_EQ(session.ghost()->world().frame(), session.world().frame());
}

TEST(Ghost, OfAnotherDivergesAndTheMainWorldDoesNotNotice) {
  Session alone(touching_pair(), {}, 1), session(touching_pair(), {}, 1);
  session.set_ghost(rk4);
  go_on(alone, 60);
  go_on(session, 60);
  EXPECT_GT(session.ghost()->distance(session.world()), 0);
  EXPECT_EQ(session.history().ghost.size(), 60u);
  EXPECT_EQ(alone.world().state_hash(), session.world().state_hash());
}

/// Both fall freely: Euler's steps end by g h t / 2 lower, h being the substep and all vertices alike.
TEST(Ghost, ItsDistanceIsThatOfTheIntegrators) {
  softbody::Scene scene = without_solids();
  scene.gravity = {0, -10, 0};
  Session session(scene, {}, 1);
  session.set_integrator("semi-implicit-euler", 10);
  session.set_ghost(softbody::IntegratorChoice{"velocity-verlet", 10});
  go_on(session, 30);
  const double h = 1.0 / 600, t = 0.5, radius = session.world().prototype(0).radius;
  EXPECT_NEAR(session.ghost()->distance(session.world()), 0.5 * 10 * h * t / radius, 1e-4);
}

TEST(Ghost, BeginsAnewWhenTheWorldIsChangedByHand) {
  Session session(touching_pair(), {}, 1);
  session.set_ghost(rk4);
  go_on(session, 30);
  ASSERT_GT(session.ghost()->distance(session.world()), 0);
  const auto apart = [&] { return session.ghost()->distance(session.world()); };
  session.drop();
  EXPECT_EQ(session.ghost()->world().bodies().count(), 3u);
  EXPECT_EQ(apart(), 0);
  go_on(session, 5);
  session.select_body(0);
  session.remove_selected();
  EXPECT_EQ(session.ghost()->world().bodies().count(), 2u);
  EXPECT_EQ(apart(), 0);
  go_on(session, 5);
  session.rewind_to(10);
  EXPECT_EQ(session.ghost()->world().frame(), session.world().frame());
  session.reset();
  EXPECT_EQ(session.ghost()->world().frame(), 0);
  EXPECT_EQ(session.ghost()->choice(), rk4);
}

TEST(Ghost, ThatBlowsUpStops) {
  softbody::Scene scene = touching_pair();
  scene.materials[0].structural.stiffness = 20'000;
  Session session(scene, {}, 1);
  session.set_ghost(softbody::IntegratorChoice{"explicit-euler", 1});
  go_on(session, 120);
  ASSERT_TRUE(session.ghost()->blown_up());
  const int frame = session.ghost()->world().frame();
  go_on(session, 3);
  EXPECT_EQ(session.ghost()->world().frame(), frame);
  EXPECT_TRUE(session.notice().empty()) << session.notice();
}

TEST(Ghost, WhatItsIntegratorCannotMoveIsRefused) {
  softbody::Scene scene = touching_pair();
  scene.materials[0].structural.stiffness = 1e9;
  Session session(scene, {}, 1);
  session.set_ghost(softbody::IntegratorChoice{"explicit-euler", std::nullopt});
  EXPECT_EQ(session.ghost(), nullptr);
  EXPECT_NE(session.notice().find("stiff"), std::string::npos) << session.notice();
}

TEST(Ghost, IsChosenOnThePanel) {
  PanelRig rig;
  rig.click("Detection");  // folded, so that all has room
  rig.click("Numbers");
  rig.click("Stability");
  EXPECT_FALSE(rig.recorder.find("Ghost apart"));
  rig.click("Ghost world");
  ASSERT_TRUE(rig.session.ghost());
  EXPECT_TRUE(rig.recorder.find("Ghost apart"));
  rig.click("Ghost Integrator");
  rig.click("Runge-Kutta 4");
  EXPECT_EQ(rig.session.ghost()->choice().key, "rk4");
  rig.click("Ghost Fixed substeps");
  EXPECT_TRUE(rig.session.ghost()->choice().substeps);
  rig.drag("Ghost Substeps", -400);
  EXPECT_EQ(rig.session.ghost()->choice().substeps, 1);
  rig.click("Ghost world");
  EXPECT_FALSE(rig.session.ghost());
}

}  // namespace
}  // namespace app
