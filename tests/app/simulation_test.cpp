#include "app/session/simulation.h"

#include <gtest/gtest.h>

#include "app/session/body_controls.h"
#include "app/session/setting_controls.h"
#include "tests/app/scenes.h"

namespace app {
namespace THIS_FILE {

void run(session::Simulation& simulation, int frames) {
  for (int i = 0; i < frames; ++i) simulation.advance(tick);
}

TEST(Simulation, TakesTheStepsOfItsWorldToTheBit) {
  softbody::World world(touching_pair(), {});
  session::Simulation simulation(touching_pair(), 2);
  for (int frame = 0; frame < 120; ++frame) {
    world.step();
    simulation.advance(tick);
    ASSERT_EQ(simulation.simulated()->state_hash(), world.state_hash()) << frame;
  }
}

TEST(Simulation, InterpolatesSlowMotionBetweenTwoSteps) {
  session::Simulation simulation(touching_pair(), 1);
  EXPECT_EQ(simulation.between(), 1.0f);
  simulation.clock.slow_motion = true;
  simulation.clock.slow_factor = 0.25;
  float last = -1;
  for (int i = 0; i < 3; ++i) {
    simulation.advance(tick);
    EXPECT_GT(simulation.between(), last);
    EXPECT_LT(simulation.between(), 1.0f);
    last = simulation.between();
  }
  const float height = simulation.world().positions().y[0];
  simulation.advance(tick);
  EXPECT_LT(simulation.between(), last);
  EXPECT_EQ(simulation.before_last_step().shown().y[0], height);
  simulation.clock.paused = true;
  EXPECT_EQ(simulation.between(), 1.0f);
}

TEST(Simulation, HasTheCaptionOfTheFrame) {
  session::Simulation simulation(touching_pair(), 1);
  EXPECT_EQ(simulation.caption(), "");
  for (int i = 0; i < 4; ++i) simulation.advance(tick);
  EXPECT_EQ(simulation.caption(), "second");
  for (int i = 0; i < 4; ++i) simulation.advance(tick);
  EXPECT_EQ(simulation.caption(), "fifth");
}

TEST(Simulation, KeepsTheSettingsOverAReset) {
  session::Simulation simulation(touching_pair(), 1);
  session::SettingControls controls(simulation);
  session::BodyControls bodies(simulation);
  controls.set_method("grid-hash");
  collide::Settings settings = simulation.world().collision();
  settings.buckets = 77;
  settings.cell_size = glm::vec3(0.25f);
  simulation.change_scene("Settings", [&](softbody::Scene& s) { s.collision = settings; });
  bodies.drop();
  for (int i = 0; i < 5; ++i) simulation.advance(tick);
  simulation.reset();
  EXPECT_EQ(simulation.world().frame(), 0);
  EXPECT_EQ(simulation.world().bodies().count(), 2u);
  EXPECT_EQ(simulation.world().method().key, "grid-hash");
  EXPECT_EQ(simulation.world().collision().buckets, 77u);
  EXPECT_EQ(simulation.world().collision().cell_size, glm::vec3(0.25f));
  controls.restore_detection();
  EXPECT_EQ(simulation.world().method().key, collide::default_method);
  EXPECT_EQ(simulation.world().collision().buckets, 1001u);
  EXPECT_FALSE(simulation.world().scene().collision.cell_size);
}

TEST(Simulation, KeepsTheContactSurfaceOverAReset) {
  session::Simulation simulation(touching_pair(), 1);
  session::SettingControls controls(simulation);
  const auto surface = [&] { return simulation.world().scene().contact_surface; };
  const auto revision = simulation.revision();
  simulation.change_scene("Contact",
                          [&](softbody::Scene& s) { s.contact_surface = softbody::ContactSurface::surfaces; });
  EXPECT_NE(simulation.revision(), revision);
  simulation.advance(tick);
  simulation.reset();
  EXPECT_EQ(surface(), softbody::ContactSurface::surfaces);
  controls.restore_detection();
  EXPECT_EQ(surface(), softbody::ContactSurface::vertices);
}

TEST(Simulation, GoesBackAndContinuesToTheBit) {
  session::Simulation simulation(touching_pair(), 1);
  run(simulation, 63);
  const std::uint64_t there = simulation.simulated()->state_hash();
  const std::uint64_t revision = simulation.revision();
  simulation.rewind_to(31);
  EXPECT_TRUE(simulation.clock.paused);
  EXPECT_EQ(simulation.world().frame(), 30);
  EXPECT_GT(simulation.revision(), revision);
  EXPECT_EQ(simulation.before_last_step().shown().y[0], simulation.world().positions().y[0]);
  simulation.rewind_to(63);
  EXPECT_EQ(simulation.world().frame(), 63) << "the present was kept";
  EXPECT_EQ(simulation.simulated()->state_hash(), there);
  simulation.rewind_to(30);
  simulation.clock.paused = false;
  run(simulation, 33);
  EXPECT_EQ(simulation.world().frame(), 63);
  EXPECT_EQ(simulation.simulated()->state_hash(), there);
}

TEST(Simulation, ShowsTheFiguresOfTheFrameItWentBackTo) {
  session::Simulation simulation(touching_pair(), 1);
  run(simulation, 63);
  simulation.rewind_to(30);
  const softbody::Measures now = softbody::measure(*simulation.simulated());
  const session::StabilityHistory& shown = simulation.stability().history();
  EXPECT_FLOAT_EQ(shown.kinetic.latest(), float(now.energies.kinetic));
  EXPECT_FLOAT_EQ(shown.gravity.latest(), float(now.energies.gravity));
  EXPECT_FLOAT_EQ(shown.speed.latest(), float(now.max_speed));
  for (const TimeSeries* ring : std::initializer_list<const TimeSeries*>{&shown.total, &simulation.history.contacts}) {
    ASSERT_GT(ring->size(), 0u);
    EXPECT_LE(ring->frame(ring->size() - 1), 30);
  }
  EXPECT_EQ(simulation.stability().margin().taken, 0);
  EXPECT_FALSE(simulation.world().all_at_rest()) << "so the light may not say that nothing moves";
}

TEST(Simulation, KeepsTheSettingsInUseWhenItGoesBack) {
  session::Simulation simulation(touching_pair(), 1);
  session::SettingControls controls(simulation);
  session::BodyControls bodies(simulation);
  run(simulation, 20);
  bodies.drop();
  run(simulation, 20);
  controls.set_method("grid-hash");
  simulation.change_scene("Contact",
                          [&](softbody::Scene& s) { s.contact_surface = softbody::ContactSurface::surfaces; });
  collide::Settings settings = simulation.world().collision();
  settings.buckets = 77;
  simulation.change_scene("Settings", [&](softbody::Scene& s) { s.collision = settings; });
  simulation.rewind_to(10);
  EXPECT_EQ(simulation.world().bodies().count(), 2u);
  EXPECT_EQ(simulation.world().method().key, "grid-hash");
  EXPECT_EQ(simulation.world().collision().buckets, 77u);
  EXPECT_TRUE(simulation.world().scene().collision.cell_size);
  EXPECT_EQ(simulation.world().scene().contact_surface, softbody::ContactSurface::surfaces);
}

TEST(Simulation, PausesAtABlowUpAndOffersTheLastGoodFrame) {
  session::Simulation simulation(doomed_pair(), 1);
  run(simulation, 40);
  ASSERT_TRUE(simulation.stability().blow_up());
  EXPECT_TRUE(simulation.clock.paused);
  EXPECT_EQ(simulation.stability().blow_up()->body, 1u);
  const int bad = simulation.stability().blow_up()->frame;
  EXPECT_EQ(simulation.world().frame(), bad);
  EXPECT_LT(simulation.stability().last_good_frame(), bad);
  simulation.rewind_to(simulation.stability().last_good_frame());
  EXPECT_FALSE(simulation.stability().blow_up());
  EXPECT_TRUE(softbody::measure(*simulation.simulated()).finite);
}

TEST(Simulation, ContinuesThroughABlowUpOnRequest) {
  session::Simulation simulation(doomed_pair(), 1);
  simulation.pause_on_blow_up = false;
  run(simulation, 40);
  EXPECT_FALSE(simulation.stability().blow_up());
  EXPECT_FALSE(simulation.clock.paused);
  simulation.reset();
  simulation.pause_on_blow_up = true;
  run(simulation, 40);
  ASSERT_TRUE(simulation.stability().blow_up());
  simulation.clock.paused = false;
  const int bad = simulation.world().frame();
  run(simulation, 5);
  EXPECT_EQ(simulation.world().frame(), bad + 5) << "it stops once, not in every frame";
  EXPECT_LT(simulation.stability().past().snapshots().back().frame, bad) << "no bad frame is kept";
  EXPECT_FALSE(simulation.stability().blow_up()) << "who goes on has read it";
}

TEST(SimulationUndo, RevertsADropAndAThrowToTheBit) {
  session::Simulation simulation(touching_pair(), 1);
  session::BodyControls bodies(simulation);
  for (int i = 0; i < 10; ++i) simulation.advance(tick);
  const std::uint64_t before = simulation.simulated()->state_hash();
  simulation.grab({.body = 0, .target = {0, 4, 0}});
  bodies.drop(20);
  EXPECT_TRUE(simulation.simulated()->grabbed()) << "a drop does not make the hand let go";
  bodies.throw_body({0, 3, 9}, {0, 3, 0});
  ASSERT_EQ(simulation.world().bodies().count(), 23u);
  simulation.advance(tick);
  simulation.undo();
  EXPECT_EQ(simulation.world().bodies().count(), 22u);
  simulation.undo();
  EXPECT_EQ(simulation.world().bodies().count(), 2u);
  EXPECT_EQ(simulation.simulated()->state_hash(), before);
  EXPECT_FALSE(simulation.simulated()->grabbed());
  EXPECT_FALSE(simulation.can_undo());
}

void set_gravity(session::Simulation& simulation, double strength) {
  simulation.change_scene("Gravity", [strength](softbody::Scene& scene) { scene.gravity = {0, -strength, 0}; });
}
double gravity(const session::Simulation& simulation) { return -simulation.world().scene().gravity.y; }

TEST(SimulationUndo, TakesBackSettingsLikeBodies) {
  session::Simulation simulation(touching_pair(), 1);
  session::SettingControls controls(simulation);
  session::BodyControls bodies(simulation);
  run(simulation, 5);
  const std::uint64_t before = simulation.simulated()->state_hash();
  bodies.drop();
  controls.set_method("grid-hash");
  set_gravity(simulation, 1.5);
  controls.set_integrator({.key = "rk4"});
  run(simulation, 5);
  simulation.undo();
  EXPECT_EQ(simulation.notice.text(), "Undone: Integrator");
  EXPECT_EQ(simulation.simulated()->integrator_choice(), softbody::IntegratorChoice());
  EXPECT_EQ(gravity(simulation), 1.5);
  simulation.undo();
  EXPECT_EQ(gravity(simulation), 9.81);
  EXPECT_EQ(simulation.world().method().key, "grid-hash");
  simulation.undo();
  EXPECT_EQ(simulation.world().method().key, collide::default_method);
  EXPECT_EQ(simulation.world().bodies().count(), 3u);
  simulation.undo();
  EXPECT_EQ(simulation.simulated()->state_hash(), before);
  EXPECT_FALSE(simulation.can_undo());
  for (int i = 0; i < 4; ++i) simulation.redo();
  EXPECT_EQ(simulation.world().bodies().count(), 3u);
  EXPECT_EQ(simulation.world().method().key, "grid-hash");
  EXPECT_EQ(gravity(simulation), 1.5);
  EXPECT_EQ(simulation.simulated()->integrator_choice().key, "rk4");
}

TEST(SimulationUndo, TakesChangesOfOneSettingThatFollowEachOtherAsOne) {
  session::Simulation simulation(touching_pair(), 1);
  const auto drag_gravity = [&] {
    for (const double strength : {3, 4, 5}) {
      set_gravity(simulation, strength);
      run(simulation, 1);
    }
  };
  drag_gravity();
  simulation.change_scene("Subdivision", [](softbody::Scene& scene) { scene.collision.levels = 6; });
  set_gravity(simulation, 7);
  simulation.undo();
  EXPECT_EQ(gravity(simulation), 5);
  drag_gravity();
  simulation.undo();
  EXPECT_EQ(gravity(simulation), 5) << "what follows an undone change is a step of its own";
  simulation.undo();
  EXPECT_EQ(simulation.world().collision().levels, 3);
  simulation.undo();
  EXPECT_EQ(gravity(simulation), 9.81);
  EXPECT_EQ(simulation.world().frame(), 0);
  EXPECT_FALSE(simulation.can_undo());
}

TEST(SimulationUndo, IgnoresASettingThatIsRefused) {
  session::Simulation simulation(touching_pair(), 1);
  const auto revision = simulation.revision();
  EXPECT_FALSE(simulation.change_scene("Tolerance", [](softbody::Scene& scene) { scene.collision.tolerance = 11; }));
  EXPECT_NE(simulation.notice.text().find("from 1e-09 to 10"), std::string::npos) << simulation.notice.text();
  EXPECT_FALSE(simulation.can_undo());
  EXPECT_EQ(simulation.revision(), revision);
  EXPECT_EQ(simulation.world().scene(), touching_pair());
}

TEST(SimulationUndo, GoesBackAsFarAsMemoryReaches) {
  session::Simulation simulation(touching_pair(), 1);
  session::BodyControls bodies(simulation);
  for (int i = 0; i < 20; ++i) bodies.drop();
  while (simulation.can_undo()) simulation.undo();
  EXPECT_EQ(simulation.world().bodies().count(), 2u);
}

TEST(SimulationUndo, IgnoresAThrowThatFailed) {
  session::Simulation simulation(touching_pair(), 1);
  session::BodyControls bodies(simulation);
  const glm::dvec3 inside(0, 0, 0);  // of the solid sphere
  bodies.throw_body(inside, {0, 0, -1});
  ASSERT_EQ(simulation.world().bodies().count(), 2u);
  EXPECT_FALSE(simulation.notice.text().empty());
  EXPECT_FALSE(simulation.can_undo());
}

TEST(SimulationUndo, RestoresADeletedBodyToTheBit) {
  session::Simulation simulation(touching_pair(), 1);
  session::BodyControls bodies(simulation);
  for (int i = 0; i < 10; ++i) simulation.advance(tick);
  const std::uint64_t before = simulation.simulated()->state_hash();
  const int frame = simulation.world().frame();
  bodies.select(0);
  bodies.remove_selected();
  EXPECT_EQ(simulation.world().body(0).number, 1u) << "the other one keeps its colour";
  for (int i = 0; i < 10; ++i) simulation.advance(tick);
  simulation.reset();  // undone first
  simulation.undo();
  EXPECT_EQ(simulation.world().bodies().count(), 1u);
  EXPECT_EQ(simulation.world().frame(), frame + 10);
  simulation.undo();
  EXPECT_EQ(simulation.world().bodies().count(), 2u);
  EXPECT_EQ(simulation.world().frame(), frame);
  EXPECT_EQ(simulation.simulated()->state_hash(), before);
  EXPECT_FALSE(simulation.can_undo());
  simulation.advance(tick);
  EXPECT_FALSE(simulation.notice.is_error());
}

TEST(SimulationUndo, RevertsSeveralResetsAndKeepsTheirSolids) {
  session::Simulation simulation(touching_pair(), 1);
  session::SettingControls controls(simulation);
  std::vector<std::uint64_t> hashes;
  for (int i = 0; i < 3; ++i) {
    softbody::Solid solid = simulation.world().scene().solids[0];
    solid.enabled = i % 2;
    controls.set_solid(0, solid);
    for (int k = 0; k < 5 + i; ++k) simulation.advance(tick);
    hashes.push_back(simulation.simulated()->state_hash());
    simulation.reset();
  }
  for (int i = 2; i >= 0; --i) {
    simulation.undo();
    EXPECT_EQ(simulation.simulated()->state_hash(), hashes[static_cast<std::size_t>(i)]);
    EXPECT_EQ(simulation.world().scene().solids[0].enabled, i % 2);
    simulation.undo();  // the switch
    EXPECT_EQ(simulation.world().scene().solids[0].enabled, i % 2 == 0);
  }
  simulation.undo();
  EXPECT_EQ(simulation.notice.text(), "Nothing to undo");
}

TEST(SimulationUndo, BringsBackTheSettingsOfAWorldThatWasLeftForAnotherScene) {
  session::Simulation simulation(touching_pair(), 1), undisturbed(touching_pair(), 1);
  for (session::Simulation* s : {&simulation, &undisturbed}) {
    session::SettingControls controls(*s);
    controls.set_method("grid-hash");
    s->change_scene("Gravity", [](softbody::Scene& scene) { scene.gravity = {0, -3, 0}; });
    controls.set_integrator({.key = "velocity-verlet"});
    run(*s, 20);
  }
  softbody::Scene other = touching_pair();
  other.bodies.resize(1);
  simulation.enter(session::make_window_world(other, {}, 1), {other, session::SceneFile("other")}, "choice of scene");
  run(simulation, 5);
  ASSERT_EQ(simulation.world().bodies().count(), 1u);
  simulation.undo();
  EXPECT_EQ(simulation.loaded.scene.bodies.size(), 2u);
  EXPECT_EQ(simulation.world().method().key, "grid-hash");
  EXPECT_EQ(simulation.simulated()->integrator_choice(), undisturbed.simulated()->integrator_choice());
  for (session::Simulation* s : {&simulation, &undisturbed}) run(*s, 20);
  EXPECT_EQ(simulation.simulated()->state_hash(), undisturbed.simulated()->state_hash());
}

/// Notes what it is told.
struct Witness : session::SimulationObserver {
  double stepped() override {
    ++steps;
    return 5;
  }
  void intervened() override { ++interventions; }
  void detection_changed() override { ++detections; }
  void replaced(bool new_scene) override { new_scene ? ++scenes : ++states; }
  int steps = 0, interventions = 0, detections = 0, scenes = 0, states = 0;
};

TEST(SimulationObserver, IsToldOfStepsAndChanges) {
  Witness witness;
  session::Simulation simulation(touching_pair(), 1, "", &witness);
  session::SettingControls controls(simulation);
  run(simulation, 7);
  EXPECT_EQ(witness.steps, 7);
  EXPECT_GE(simulation.step_ms(), 5);
  simulation.change_scene("Gravity", [&](softbody::Scene& s) { s.gravity = {0, -3, 0}; });
  EXPECT_EQ(witness.interventions, 1);
  EXPECT_EQ(witness.detections, 0);
  controls.set_method("grid-hash");
  EXPECT_EQ(witness.detections, 1);
  simulation.rewind_to(5);
  EXPECT_EQ(witness.states, 1);
  simulation.reset();
  EXPECT_EQ(witness.scenes, 1);
  simulation.undo();
  EXPECT_EQ(witness.scenes, 2);
}

TEST(SimulationRedo, BringsBackWhatWasUndoneToTheBit) {
  session::Simulation simulation(touching_pair(), 1);
  session::BodyControls bodies(simulation);
  std::vector<std::uint64_t> hashes;  // before each change, and at the end
  for (const int what : {0, 1, 2, 3}) {
    run(simulation, 5);
    hashes.push_back(simulation.simulated()->state_hash());
    if (what == 0) bodies.drop(3);
    if (what == 1) bodies.throw_body({0, 3, 9}, {0, 0, -1});
    if (what == 2) simulation.reset();
    if (what == 3) bodies.select(1), bodies.remove_selected();
  }
  run(simulation, 5);
  hashes.push_back(simulation.simulated()->state_hash());
  EXPECT_FALSE(simulation.can_redo());
  for (int round = 0; round < 2; ++round) {
    for (std::size_t i = hashes.size() - 1; i-- > 0;) {
      simulation.undo();
      EXPECT_EQ(simulation.simulated()->state_hash(), hashes[i]) << i;
    }
    EXPECT_EQ(simulation.notice.text(), "Undone: drop of 3 bodies");
    EXPECT_FALSE(simulation.can_undo());
    for (std::size_t i = 1; i < hashes.size(); ++i) {
      ASSERT_TRUE(simulation.can_redo());
      simulation.redo();
      EXPECT_EQ(simulation.simulated()->state_hash(), hashes[i]) << i;
    }
    EXPECT_EQ(simulation.notice.text(), "Redone: deletion of a body");
    EXPECT_FALSE(simulation.can_redo());
  }
  run(simulation, 20);
  const std::uint64_t later = simulation.simulated()->state_hash();
  simulation.undo();
  simulation.redo();
  EXPECT_EQ(simulation.simulated()->state_hash(), later) << "the world as it was left";
}

TEST(SimulationRedo, GoesOnAsIfNothingHadBeenUndone) {
  session::Simulation simulation(touching_pair(), 1), undisturbed(touching_pair(), 1);
  for (session::Simulation* s : {&simulation, &undisturbed}) {
    session::BodyControls bodies(*s);
    bodies.drop(2);
    run(*s, 10);
  }
  simulation.undo();
  run(simulation, 7);
  simulation.redo();
  for (session::Simulation* s : {&simulation, &undisturbed}) run(*s, 30);
  EXPECT_EQ(simulation.simulated()->state_hash(), undisturbed.simulated()->state_hash());
}

TEST(SimulationRedo, EndsWithANewChange) {
  session::Simulation simulation(touching_pair(), 1);
  session::BodyControls bodies(simulation);
  bodies.drop();
  simulation.undo();
  ASSERT_TRUE(simulation.can_redo());
  bodies.drop(2);
  EXPECT_FALSE(simulation.can_redo());
  simulation.redo();
  EXPECT_EQ(simulation.notice.text(), "Nothing to redo");
  EXPECT_EQ(simulation.world().bodies().count(), 4u);
}

TEST(SimulationUndo, UndoesAPullBeforeTheDropThatCameDuringIt) {
  session::Simulation simulation(touching_pair(), 1);
  session::BodyControls bodies(simulation);
  simulation.grab({.body = 1, .target = {0.5, 3, 0}});
  run(simulation, 3);
  bodies.drop();
  simulation.pull_to({1.5, 3, 0});
  run(simulation, 3);
  simulation.undo();
  EXPECT_EQ(simulation.world().bodies().count(), 3u);
  simulation.undo();
  EXPECT_EQ(simulation.world().bodies().count(), 2u);
  EXPECT_EQ(simulation.world().frame(), 3);
}

TEST(SimulationUndo, TakesAPullAsOneChange) {
  session::Simulation simulation(touching_pair(), 1);
  session::BodyControls bodies(simulation);
  run(simulation, 5);
  const std::uint64_t before = simulation.simulated()->state_hash();
  simulation.grab({.body = 1, .target = {0.5, 3, 0}});
  run(simulation, 2);
  EXPECT_FALSE(simulation.can_undo()) << "a click pulls nothing";
  for (int i = 1; i <= 20; ++i) {
    simulation.pull_to({0.5 + 0.1 * i, 3, 0});
    run(simulation, 1);
  }
  simulation.release();
  run(simulation, 10);
  const std::uint64_t thrown = simulation.simulated()->state_hash();
  simulation.undo();
  EXPECT_EQ(simulation.notice.text(), "Undone: pull of a body");
  EXPECT_EQ(simulation.simulated()->state_hash(), before);
  EXPECT_FALSE(simulation.can_undo());
  simulation.redo();
  EXPECT_EQ(simulation.simulated()->state_hash(), thrown);
}

TEST(SimulationUndo, TakesADragOfASolidAsOneChangeAndRestoresIt) {
  session::Simulation simulation(touching_pair(), 1);
  session::SettingControls controls(simulation);
  session::BodyControls bodies(simulation);
  run(simulation, 5);
  const std::uint64_t before = simulation.simulated()->state_hash();
  const std::vector<softbody::Solid> at_first = simulation.world().scene().solids;
  std::vector<softbody::Solid> solids = at_first;
  for (int i = 0; i < 5; ++i) {
    solids[0] = session::moved(solids[0], {0.1, 0, 0});
    controls.set_solid(0, solids[0]);
    run(simulation, 1);
  }
  set_gravity(simulation, 3);
  EXPECT_NEAR(shape_of<softbody::SolidSphere>(simulation.world().scene()).centre.x, 0.5, 1e-12);
  simulation.undo();
  EXPECT_EQ(gravity(simulation), 9.81);
  EXPECT_NEAR(shape_of<softbody::SolidSphere>(simulation.world().scene()).centre.x, 0.5, 1e-12);
  simulation.undo();
  EXPECT_EQ(simulation.notice.text(), "Undone: change of Sphere");
  EXPECT_FALSE(simulation.can_undo());
  EXPECT_EQ(simulation.simulated()->state_hash(), before);
  EXPECT_TRUE(simulation.world().scene().solids == at_first);
  EXPECT_EQ(shape_of<softbody::SolidSphere>(simulation.world().scene()).centre, glm::dvec3(0.0));
  simulation.redo();
  EXPECT_NEAR(shape_of<softbody::SolidSphere>(simulation.world().scene()).centre.x, 0.5, 1e-12);
  EXPECT_TRUE(simulation.world().scene().solids == solids);
  simulation.reset();
  EXPECT_NEAR(shape_of<softbody::SolidSphere>(simulation.world().scene()).centre.x, 0.5, 1e-12) << "a reset keeps it";
  controls.set_solid(0, at_first[0]);
  bodies.drop();
  simulation.undo();
  EXPECT_TRUE(simulation.world().scene().solids == at_first) << "the undo of a drop moves no solid";
}

TEST(Notice, GoesWithTimeUnlessItIsRenewed) {
  session::Notice notice;
  for (const char* text : {"first", "second"}) {
    notice.set(text);
    for (int i = 0; i < 30; ++i) notice.age(0.5);
    EXPECT_EQ(notice.text(), text);
  }
  notice.set("second");  // the same words again
  for (int i = 0; i < 15; ++i) notice.age(0.5);
  EXPECT_TRUE(notice.text().empty());
}

TEST(Notice, ShowsAMessageForAShorterTime) {
  session::Notice notice;
  EXPECT_FALSE(notice.is_error());
  notice.set("wrong");
  EXPECT_TRUE(notice.is_error());
  for (int i = 0; i < 30; ++i) notice.age(0.5);
  for (int round = 0; round < 2; ++round) {
    notice.tell("done");
    EXPECT_FALSE(notice.is_error());
    for (int i = 0; i < 8; ++i) notice.age(0.5);
    EXPECT_EQ(notice.text(), "done") << "the second time as long as the first";
  }
  notice.age(0.5);
  EXPECT_EQ(notice.text(), "");
  notice.set("wrong");
  notice.clear();
  EXPECT_FALSE(notice.is_error());
}

TEST(FieldNotice, GoesWhenTheFieldIsChanged) {
  session::FieldNotice notice;
  EXPECT_EQ(notice.about(""), "");
  notice.set("a.toml", "cannot be read");
  EXPECT_EQ(notice.about("a.toml"), "cannot be read");
  EXPECT_EQ(notice.about("b.toml"), "");
  notice.clear();
  EXPECT_EQ(notice.about("a.toml"), "");
}

}  // namespace THIS_FILE
}  // namespace app
