#include "app/session/simulation.h"

#include <gtest/gtest.h>

#include "app/session/body_controls.h"
#include "app/session/setting_controls.h"
#include "tests/app/scenes.h"

namespace app {
namespace THIS_FILE {

struct Observer : session::SimulationObserver {
  double stepped() override { return 1e6; }  // ms, longer than any step
};

class SimulationTest : public testing::Test {
 protected:
  std::uint64_t hash() const { return simulation.simulated()->state_hash(); }
  std::size_t count() const { return simulation.world().bodies().count(); }
  double gravity() const { return -simulation.world().scene().gravity.y; }
  void set_gravity(double strength) {
    simulation.change_scene("Gravity", [strength](softbody::Scene& scene) { scene.gravity = {0, -strength, 0}; });
  }
  /// Sets a method, 77 buckets, a cell size and the contact of surfaces.
  void change_detection() {
    controls.set_method("grid-hash");
    simulation.change_scene("Settings", [](softbody::Scene& scene) {
      scene.collision.buckets = 77;
      scene.collision.cell_size = glm::vec3(0.25f);
      scene.contact_surface = softbody::ContactSurface::surfaces;
    });
  }
  void expect_changed_detection() const {
    EXPECT_EQ(simulation.world().method().key, "grid-hash");
    EXPECT_EQ(simulation.world().collision().buckets, 77u);
    EXPECT_EQ(simulation.world().collision().cell_size, glm::vec3(0.25f));
    EXPECT_EQ(simulation.world().scene().contact_surface, softbody::ContactSurface::surfaces);
  }

  Observer observer;
  session::Simulation simulation{touching_pair(), 1, "", &observer};
  session::SettingControls controls{simulation};
  session::BodyControls bodies{simulation};
};

TEST_F(SimulationTest, TakesTheStepsOfItsWorldToTheBit) {
  softbody::World world(touching_pair(), {});
  session::Simulation with_threads(touching_pair(), 2);
  for (int frame = 0; frame < 120; ++frame) {
    world.step();
    run(with_threads, 1);
    ASSERT_EQ(with_threads.simulated()->state_hash(), world.state_hash()) << frame;
  }
}

TEST_F(SimulationTest, InterpolatesSlowMotionBetweenTwoSteps) {
  EXPECT_EQ(between(simulation), 1.0f);
  simulation.clock.slow_motion = true;
  simulation.clock.slow_factor = 0.25;
  float last = -1;
  for (int i = 0; i < 3; ++i) {
    run(simulation, 1);
    EXPECT_GT(between(simulation), last);
    EXPECT_LT(between(simulation), 1.0f);
    last = between(simulation);
  }
  const float height = simulation.world().positions().y[0];
  run(simulation, 1);
  EXPECT_LT(between(simulation), last);
  EXPECT_EQ(simulation.before_last_step().shown().y[0], height);
  simulation.clock.paused = true;
  EXPECT_EQ(between(simulation), 1.0f);
}

TEST_F(SimulationTest, CountsTheTimeOfItsObserverAsPartOfAStep) {
  run(simulation, 1);
  EXPECT_GE(simulation.step_ms(), 1e6);
}

TEST_F(SimulationTest, HasTheCaptionOfTheFrame) {
  for (const char* caption : {"", "second", "fifth"}) {
    EXPECT_EQ(simulation.caption(), caption);
    run(simulation, 4);
  }
}

TEST_F(SimulationTest, KeepsTheSettingsInUseOverAReset) {
  const auto revision = simulation.revision();
  change_detection();
  EXPECT_NE(simulation.revision(), revision);
  controls.set_integrator({"xpbd", 7});
  bodies.drop();
  run(simulation, 5);
  simulation.reset();
  EXPECT_EQ(simulation.world().frame(), 0);
  EXPECT_EQ(count(), 2u);
  EXPECT_EQ(simulation.simulated()->integrator_choice(), (softbody::IntegratorChoice{"xpbd", 7}));
  expect_changed_detection();
  controls.restore_detection();
  EXPECT_EQ(simulation.world().method().key, collide::default_method);
  EXPECT_EQ(simulation.world().collision().buckets, 1001u);
  EXPECT_FALSE(simulation.world().scene().collision.cell_size);
  EXPECT_EQ(simulation.world().scene().contact_surface, softbody::ContactSurface::vertices);
}

TEST_F(SimulationTest, KeepsTheSettingsInUseWhenItGoesBack) {
  run(simulation, 20);
  bodies.drop();
  run(simulation, 20);
  change_detection();
  simulation.rewind_to(10);
  EXPECT_EQ(count(), 2u);
  expect_changed_detection();
}

TEST_F(SimulationTest, GoesBackAndContinuesToTheBit) {
  run(simulation, 63);
  const std::uint64_t there = hash();
  const std::uint64_t revision = simulation.revision();
  simulation.rewind_to(31);
  EXPECT_TRUE(simulation.clock.paused);
  EXPECT_EQ(simulation.world().frame(), 30);
  EXPECT_GT(simulation.revision(), revision);
  EXPECT_EQ(simulation.before_last_step().shown().y[0], simulation.world().positions().y[0]);
  simulation.rewind_to(63);
  EXPECT_EQ(simulation.world().frame(), 63) << "the present was kept";
  EXPECT_EQ(hash(), there);
  simulation.rewind_to(30);
  simulation.clock.paused = false;
  run(simulation, 33);
  EXPECT_EQ(simulation.world().frame(), 63);
  EXPECT_EQ(hash(), there);
}

TEST_F(SimulationTest, ShowsTheFiguresOfTheFrameItWentBackTo) {
  run(simulation, 63);
  simulation.rewind_to(30);
  const softbody::Measures now = softbody::measure(*simulation.simulated());
  const session::StabilityHistory& shown = simulation.stability().history();
  const auto start = simulation.world().model(0).start_energy;
  for (std::size_t i = 0; i < shown.size(); ++i)
    EXPECT_FLOAT_EQ(shown[i].latest(),
                    float(session::stability_quantities[i].of(now, {2 * start.elastic, 2 * start.gas})))
        << session::stability_quantities[i].name;
  const TimeSeries &speed = shown.back(), &contacts = simulation.history.contacts;
  EXPECT_FLOAT_EQ(speed.latest(), float(now.max_speed));
  for (const TimeSeries* ring : {&speed, &contacts}) {
    ASSERT_GT(ring->size(), 0u);
    EXPECT_LE(ring->frame(ring->size() - 1), 30);
  }
  EXPECT_EQ(simulation.stability().margin().taken, 0);
  EXPECT_FALSE(simulation.world().all_at_rest()) << "so the light may not say that nothing moves";
}

TEST_F(SimulationTest, PausesAtABlowUpAndOffersTheLastGoodFrame) {
  session::Simulation doomed(doomed_pair(), 1);
  run(doomed, 40);
  ASSERT_TRUE(doomed.stability().blow_up());
  EXPECT_TRUE(doomed.clock.paused);
  EXPECT_EQ(doomed.stability().blow_up()->body, 1u);
  const int bad = doomed.stability().blow_up()->frame;
  EXPECT_EQ(doomed.world().frame(), bad);
  EXPECT_LT(doomed.stability().last_good_frame(), bad);
  doomed.rewind_to(doomed.stability().last_good_frame());
  EXPECT_FALSE(doomed.stability().blow_up());
  EXPECT_TRUE(softbody::measure(*doomed.simulated()).finite);
}

TEST_F(SimulationTest, ContinuesThroughABlowUpOnRequest) {
  session::Simulation doomed(doomed_pair(), 1);
  doomed.pause_on_blow_up = false;
  run(doomed, 40);
  EXPECT_FALSE(doomed.stability().blow_up());
  EXPECT_FALSE(doomed.clock.paused);
  doomed.reset();
  doomed.pause_on_blow_up = true;
  run(doomed, 40);
  ASSERT_TRUE(doomed.stability().blow_up());
  doomed.clock.paused = false;
  const int bad = doomed.world().frame();
  run(doomed, 5);
  EXPECT_EQ(doomed.world().frame(), bad + 5) << "it stops once, not in every frame";
  EXPECT_LT(doomed.stability().past().snapshots().back().frame, bad) << "no bad frame is kept";
  EXPECT_FALSE(doomed.stability().blow_up()) << "who goes on has read it";
}

class SimulationUndo : public SimulationTest {};

TEST_F(SimulationUndo, TakesBackSettingsLikeBodies) {
  run(simulation, 5);
  const std::uint64_t before = hash();
  bodies.drop();
  controls.set_method("grid-hash");
  set_gravity(1.5);
  controls.set_integrator({.key = "rk4"});
  run(simulation, 5);
  undo(simulation);
  EXPECT_EQ(simulation.notice.text(), "Undone: Integrator");
  EXPECT_EQ(simulation.simulated()->integrator_choice(), softbody::IntegratorChoice());
  EXPECT_EQ(gravity(), 1.5);
  undo(simulation);
  EXPECT_EQ(gravity(), 9.81);
  EXPECT_EQ(simulation.world().method().key, "grid-hash");
  undo(simulation);
  EXPECT_EQ(simulation.world().method().key, collide::default_method);
  EXPECT_EQ(count(), 3u);
  undo(simulation);
  EXPECT_EQ(hash(), before);
  EXPECT_FALSE(can_undo(simulation));
  for (int i = 0; i < 4; ++i) redo(simulation);
  EXPECT_EQ(count(), 3u);
  EXPECT_EQ(simulation.world().method().key, "grid-hash");
  EXPECT_EQ(gravity(), 1.5);
  EXPECT_EQ(simulation.simulated()->integrator_choice().key, "rk4");
}

TEST_F(SimulationUndo, TakesChangesOfOneSettingThatFollowEachOtherAsOne) {
  const auto drag_gravity = [&] {
    for (const double strength : {3, 4, 5}) {
      set_gravity(strength);
      run(simulation, 1);
    }
  };
  drag_gravity();
  simulation.change_scene("Level", [](softbody::Scene& scene) { scene.collision.levels = 6; });
  set_gravity(7);
  undo(simulation);
  EXPECT_EQ(gravity(), 5);
  drag_gravity();
  undo(simulation);
  EXPECT_EQ(gravity(), 5) << "what follows an undone change is a step of its own";
  undo(simulation);
  EXPECT_EQ(simulation.world().collision().levels, 3);
  undo(simulation);
  EXPECT_EQ(gravity(), 9.81);
  EXPECT_EQ(simulation.world().frame(), 0);
  EXPECT_FALSE(can_undo(simulation));
}

TEST_F(SimulationUndo, IgnoresWhatIsRefused) {
  const auto revision = simulation.revision();
  EXPECT_FALSE(simulation.change_scene("Tolerance", [](softbody::Scene& scene) { scene.collision.tolerance = 11; }));
  EXPECT_NE(simulation.notice.text().find("from 1e-09 to 10"), std::string::npos) << simulation.notice.text();
  EXPECT_EQ(simulation.revision(), revision);
  EXPECT_EQ(simulation.world().scene(), touching_pair());
  bodies.throw_body({0, 0, 0}, {0, 0, -1});  // from inside the solid sphere
  EXPECT_EQ(count(), 2u);
  EXPECT_NE(simulation.notice.text().find("no room"), std::string::npos) << simulation.notice.text();
  EXPECT_FALSE(can_undo(simulation));
}

TEST_F(SimulationUndo, BringsBackTheSettingsOfAWorldThatWasLeftForAnotherScene) {
  session::Simulation undisturbed(touching_pair(), 1);
  for (session::Simulation* s : {&simulation, &undisturbed}) {
    session::SettingControls(*s).set_method("grid-hash");
    s->change_scene("Gravity", [](softbody::Scene& scene) { scene.gravity = {0, -3, 0}; });
    session::SettingControls(*s).set_integrator({.key = "velocity-verlet"});
    run(*s, 20);
  }
  softbody::Scene other = touching_pair();
  other.bodies.resize(1);
  simulation.enter(session::make_window_world(other, {}, 1), {other, session::SceneFile("other")}, "choice of scene");
  run(simulation, 5);
  ASSERT_EQ(count(), 1u);
  undo(simulation);
  EXPECT_EQ(simulation.loaded.scene.bodies.size(), 2u);
  EXPECT_EQ(simulation.world().method().key, "grid-hash");
  EXPECT_EQ(simulation.simulated()->integrator_choice(), undisturbed.simulated()->integrator_choice());
  for (session::Simulation* s : {&simulation, &undisturbed}) run(*s, 20);
  EXPECT_EQ(hash(), undisturbed.simulated()->state_hash());
}

TEST_F(SimulationUndo, GoesThereAndBackToTheBit) {
  std::vector<std::uint64_t> hashes;  // before each change, and at the end
  for (const int what : {0, 1, 2, 3}) {
    run(simulation, 5);
    hashes.push_back(hash());
    if (what == 0) bodies.drop(3);
    if (what == 1) bodies.throw_body({0, 3, 9}, {0, 0, -1});
    if (what == 2) simulation.reset();
    if (what == 3) bodies.select(0), bodies.remove_selected();
  }
  EXPECT_EQ(simulation.world().body(0).number, 1u) << "the body that is left keeps its colour";
  run(simulation, 5);
  hashes.push_back(hash());
  EXPECT_FALSE(can_redo(simulation));
  for (int round = 0; round < 2; ++round) {
    for (std::size_t i = hashes.size() - 1; i-- > 0;) {
      undo(simulation);
      EXPECT_EQ(hash(), hashes[i]) << i;
    }
    EXPECT_EQ(simulation.notice.text(), "Undone: drop of 3 bodies");
    EXPECT_FALSE(can_undo(simulation));
    undo(simulation);
    EXPECT_EQ(simulation.notice.text(), "Nothing to undo");
    for (std::size_t i = 1; i < hashes.size(); ++i) {
      ASSERT_TRUE(can_redo(simulation));
      redo(simulation);
      EXPECT_EQ(hash(), hashes[i]) << i;
    }
    EXPECT_EQ(simulation.notice.text(), "Redone: deletion of a body");
    EXPECT_FALSE(can_redo(simulation));
  }
  run(simulation, 20);
  const std::uint64_t later = hash();
  undo(simulation);
  redo(simulation);
  EXPECT_EQ(hash(), later) << "the world as it was left";
}

TEST_F(SimulationUndo, LeavesNothingToRedoAfterANewChange) {
  bodies.drop();
  undo(simulation);
  ASSERT_TRUE(can_redo(simulation));
  bodies.drop(2);
  EXPECT_FALSE(can_redo(simulation));
  redo(simulation);
  EXPECT_EQ(simulation.notice.text(), "Nothing to redo");
  EXPECT_EQ(count(), 4u);
}

TEST_F(SimulationUndo, TakesAPullAsOneChangeAfterTheDropThatCameDuringIt) {
  simulation.grab({.body = 1, .target = {0.5, 3, 0}});
  run(simulation, 3);
  EXPECT_FALSE(can_undo(simulation)) << "a click pulls nothing";
  bodies.drop();
  const std::uint64_t dropped = hash();
  EXPECT_TRUE(simulation.simulated()->grabbed()) << "a drop does not make the hand let go";
  for (int i = 1; i <= 20; ++i) {
    simulation.pull_to({0.5 + 0.1 * i, 3, 0});
    run(simulation, 1);
  }
  simulation.release();
  run(simulation, 10);
  const std::uint64_t thrown = hash();
  undo(simulation);
  EXPECT_EQ(simulation.notice.text(), "Undone: pull of a body");
  EXPECT_EQ(hash(), dropped);
  redo(simulation);
  EXPECT_EQ(hash(), thrown);
  undo(simulation);
  undo(simulation);
  EXPECT_EQ(count(), 2u);
  EXPECT_EQ(simulation.world().frame(), 3);
  EXPECT_FALSE(simulation.simulated()->grabbed()) << "nobody would let go";
}

TEST_F(SimulationUndo, TakesADragOfASolidAsOneChange) {
  run(simulation, 5);
  const std::uint64_t before = hash();
  const auto solids = [&] { return simulation.world().scene().solids; };
  const std::vector<softbody::Solid> at_first = solids();
  for (int i = 0; i < 5; ++i) {
    controls.set_solid(0, session::moved(solids()[0], {0.1, 0, 0}));
    run(simulation, 1);
  }
  const std::vector<softbody::Solid> dragged = solids();
  EXPECT_NEAR(shape_of<softbody::SolidSphere>(simulation.world().scene()).centre.x, 0.5, 1e-12);
  set_gravity(3);
  undo(simulation);
  EXPECT_EQ(gravity(), 9.81);
  EXPECT_TRUE(solids() == dragged);
  undo(simulation);
  EXPECT_EQ(simulation.notice.text(), "Undone: change of Sphere");
  EXPECT_FALSE(can_undo(simulation));
  EXPECT_EQ(hash(), before);
  EXPECT_TRUE(solids() == at_first);
  redo(simulation);
  simulation.reset();
  EXPECT_TRUE(solids() == dragged) << "a reset keeps them";
  controls.set_solid(0, at_first[0]);
  bodies.drop();
  undo(simulation);
  EXPECT_TRUE(solids() == at_first) << "the undo of a drop moves no solid";
}

TEST(Notice, GoesWithTimeUnlessItIsRenewed) {
  session::Notice notice;
  for (const char* text : {"first", "second"}) {
    notice.set(text);
    EXPECT_TRUE(notice.is_error());
    for (int i = 0; i < 30; ++i) notice.age(0.5);
    EXPECT_EQ(notice.text(), text);
  }
  notice.set("second");  // the same words again
  for (int i = 0; i < 15; ++i) notice.age(0.5);
  EXPECT_EQ(notice.text(), "");
  for (int round = 0; round < 2; ++round) {
    notice.tell("done");
    EXPECT_FALSE(notice.is_error());
    for (int i = 0; i < 8; ++i) notice.age(0.5);
    EXPECT_EQ(notice.text(), "done") << "for a shorter time, the second time as long as the first";
  }
  notice.age(0.5);
  EXPECT_EQ(notice.text(), "");
  notice.set("wrong");
  notice.clear();
  EXPECT_FALSE(notice.is_error());
}

}  // namespace THIS_FILE
}  // namespace app
