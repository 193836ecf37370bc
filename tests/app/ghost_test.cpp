#include "app/session/live/ghost.h"

#include <gtest/gtest.h>

#include "softbody/forces/springs.h"
#include "softbody/model/body_model.h"
#include "tests/app/panel_rig.h"

namespace app {
namespace THIS_FILE {

const softbody::IntegratorChoice rk4{"rk4", 8};

TEST(Ghost, IsTheSameToTheBitWithTheSameIntegratorAndDivergesWithAnother) {
  Session alone(touching_pair(), {}, 1), session(touching_pair(), {}, 1);
  const softbody::IntegratorChoice choice{"semi-implicit-euler", std::nullopt};
  for (Session* each : {&alone, &session}) {
    each->settings.set_integrator(choice);
    run(*each, 10);
  }
  session.choose_ghost(choice);
  for (Session* each : {&alone, &session}) run(*each, 20);
  EXPECT_EQ(session.ghost().distance(*session.simulated()), 0);
  EXPECT_EQ(session.ghost().world()->state_hash(), session.simulated()->state_hash());
  EXPECT_EQ(session.ghost().world()->frame(), session.world().frame());
  session.choose_ghost(rk4);
  for (Session* each : {&alone, &session}) run(*each, 30);
  EXPECT_GT(session.ghost().distance(*session.simulated()), 0);
  EXPECT_EQ(session.ghost().distances().size(), 30u);
  EXPECT_EQ(alone.simulated()->state_hash(), session.simulated()->state_hash()) << "the world does not notice";
}

/// Both fall freely: Euler's steps end by g h t / 2 lower, h being the substep and all vertices alike.
TEST(Ghost, HasTheDistanceOfTheIntegrators) {
  softbody::Scene scene = without_solids();
  scene.gravity = {0, -10, 0};
  Session session(scene, {}, 1);
  session.settings.set_integrator({"semi-implicit-euler", 10});
  session.choose_ghost(softbody::IntegratorChoice{"velocity-verlet", 10});
  run(session, 30);
  const double h = 1.0 / 600, t = 0.5, radius = session.world().model(0).radius;
  EXPECT_NEAR(session.ghost().distance(*session.simulated()), 0.5 * 10 * h * t / radius, 1e-4);
}

TEST(Ghost, BeginsAnewWhenTheWorldIsChangedByHand) {
  Session session(touching_pair(), {}, 1);
  session.choose_ghost(rk4);
  run(session, 30);
  const auto apart = [&] { return session.ghost().distance(*session.simulated()); };
  ASSERT_GT(apart(), 0);
  session.bodies.drop();
  EXPECT_EQ(session.ghost().world()->bodies().count(), 3u);
  EXPECT_EQ(apart(), 0);
  run(session, 5);
  session.bodies.select(0);
  session.bodies.remove_selected();
  EXPECT_EQ(session.ghost().world()->bodies().count(), 2u);
  EXPECT_EQ(apart(), 0);
  run(session, 5);
  session.simulation.rewind_to(10);
  EXPECT_EQ(session.ghost().world()->frame(), session.world().frame());
  session.simulation.reset();
  EXPECT_EQ(session.ghost().world()->frame(), 0);
  EXPECT_EQ(session.ghost().world()->integrator_choice(), rk4);
}

TEST(Ghost, StopsWhenItBlowsUp) {
  softbody::Scene scene = touching_pair();
  scene.materials[0][softbody::StructuralSprings::stiffness] = 20'000;
  Session session(scene, {}, 1);
  session.choose_ghost(softbody::IntegratorChoice{"explicit-euler", 1});
  run(session, 120);
  ASSERT_TRUE(session.ghost().blown_up());
  const int frame = session.ghost().world()->frame();
  run(session, 3);
  EXPECT_EQ(session.ghost().world()->frame(), frame);
  EXPECT_TRUE(session.simulation.notice.text().empty()) << session.simulation.notice.text();
}

TEST(Ghost, RefusesWhatItsIntegratorCannotMove) {
  softbody::Scene scene = touching_pair();
  scene.bodies[0].mesh.subdivisions = 4;
  Session session(scene, {}, 1);
  session.choose_ghost(softbody::IntegratorChoice{"implicit", std::nullopt});
  EXPECT_EQ(session.ghost().world(), nullptr);
  EXPECT_NE(session.simulation.notice.text().find("too large a matrix"), std::string::npos)
      << session.simulation.notice.text();
}

TEST(Ghost, IsChosenOnThePanel) {
  PanelRig rig;
  rig.open("Stability");
  EXPECT_FALSE(rig.recorder.find("Ghost distance"));
  rig.click("Ghost world");
  ASSERT_TRUE(rig.session.ghost().world());
  EXPECT_TRUE(rig.recorder.find("Ghost distance"));
  rig.click("Ghost Integrator");
  rig.click("Runge-Kutta 4");
  EXPECT_EQ(rig.session.ghost().world()->integrator_choice().key, "rk4");
  rig.click("Ghost Fixed substeps");
  EXPECT_TRUE(rig.session.ghost().world()->integrator_choice().substeps);
  rig.drag("Ghost Substeps", -400);
  EXPECT_EQ(rig.session.ghost().world()->integrator_choice().substeps, 1);
  rig.click("Ghost world");
  EXPECT_FALSE(rig.session.ghost().world());
}

}  // namespace THIS_FILE
}  // namespace app
