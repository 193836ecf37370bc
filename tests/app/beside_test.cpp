// Two worlds side by side: each moves as it would alone, and what the user does acts in both.

#include "app/session/live/beside.h"

#include <gtest/gtest.h>

#include "app/window/scene_mouse.h"
#include "softbody/forces/springs.h"
#include "tests/app/panel_rig.h"

namespace app {
namespace THIS_FILE {

using compare::HowSimulated;
using session::Half;

/// Returns how the paper's method simulates the touching pair with these cells (m).
HowSimulated by_paper(float cell) {
  softbody::Scene scene = touching_pair();
  scene.method = collide::paper_method;
  scene.collision.cell_size = glm::vec3(cell);
  return {scene, {}};
}

class BesideTest : public testing::Test {
 protected:
  const softbody::World& world(Half half) const { return *session.simulation.simulated(half); }
  std::uint64_t hash(Half half) const { return world(half).state_hash(); }
  const compare::RunTotals& totals(Half half) const { return session.simulation.beside()->figures(half).totals(); }
  void expect_same_numbers() const {
    const collide::Index count = world(Half::first).bodies().count();
    ASSERT_EQ(world(Half::second).bodies().count(), count);
    for (collide::Index b = 0; b < count; ++b)
      EXPECT_EQ(world(Half::second).body(b).number, world(Half::first).body(b).number);
  }

  Session session{touching_pair(), {}, 1};
};

TEST_F(BesideTest, MovesBothHalvesAsTheyWouldMoveAlone) {
  HowSimulated second = by_paper(0.1f);
  second.scene.contact_surface = softbody::ContactSurface::surfaces;
  second.integrator = {"rk4", {}};
  softbody::World first_alone(touching_pair(), {}), second_alone(second.scene, {.integrator = second.integrator});
  session.simulation.set_beside(second);
  for (int frame = 0; frame < 90; ++frame) {
    first_alone.step();
    second_alone.step();
    run(session, 1);
    ASSERT_EQ(hash(Half::first), first_alone.state_hash()) << frame;
    ASSERT_EQ(hash(Half::second), second_alone.state_hash()) << frame;
  }
}

TEST_F(BesideTest, IsTheSameToTheBitWithoutADifferenceAndGoesOnFromAnyFrame) {
  run(session, 20);
  session.simulation.set_beside(
      compare::HowSimulated{session.world().scene(), session.simulated()->integrator_choice()});
  run(session, 60);
  EXPECT_EQ(hash(Half::first), hash(Half::second));
  EXPECT_EQ(totals(Half::second).frames, 60);
}

TEST_F(BesideTest, CountsWhatEachHalfMisses) {
  session.simulation.set_beside(by_paper(0.02f));
  run(session, 30);
  EXPECT_EQ(totals(Half::first).missed, 0u);
  EXPECT_GT(totals(Half::first).true_contacts, 0u);
  EXPECT_GT(totals(Half::second).missed, 0u);
  EXPECT_FALSE(session.simulation.beside()->figures(Half::second).missed().empty());
}

TEST_F(BesideTest, LetsDropsThrowsDeletionsAndPullsActInBoth) {
  session.simulation.set_beside(by_paper(0.1f));
  run(session, 30);
  session.bodies.drop(3);
  session.bodies.throw_body({0, 3, 8}, {0, 2, 0});
  expect_same_numbers();
  const glm::dvec3 dropped = centre(world(Half::first), 2);
  EXPECT_EQ(centre(world(Half::second), 2), dropped) << "at the same place";
  session.bodies.select(1);
  session.bodies.remove_selected();
  session.bodies.drop();
  expect_same_numbers();
  session.simulation.grab({.body = 0, .target = {0, 9, 0}});
  session.simulation.pull_to({0, 9, 0});
  run(session, 30);
  EXPECT_GT(centre(world(Half::second), 0).y, 3);
  session.simulation.release();
  run(session, 60);
  const glm::dvec3 before = centre(world(Half::second), 0);
  softbody::Grab still{.body = 0};
  still.target = session::held_point(world(Half::first), still);
  session.simulation.grab(still);
  run(session, 1);
  EXPECT_LT(glm::distance(world(Half::second).grabbed()->target, session::held_point(world(Half::second), still)), 0.2)
      << "a hand that does not pull pulls nothing in the other half, wherever the body is there";
  EXPECT_LT(glm::distance(centre(world(Half::second), 0), before), 0.2);
  session.simulation.release();
  run(session, 1);
  EXPECT_FALSE(world(Half::second).grabbed());
}

TEST_F(BesideTest, LetsHoldsActInBoth) {
  session.simulation.set_beside(by_paper(0.1f));
  run(session, 10);
  session.bodies.select(1);
  session.bodies.switch_hold(7);
  run(session, 20);
  for (const Half half : {Half::first, Half::second}) EXPECT_EQ(world(half).particle(1, 7).velocity, glm::dvec3(0.0));
  session.bodies.switch_hold(7);
  run(session, 20);
  for (const Half half : {Half::first, Half::second}) EXPECT_LT(world(half).particle(1, 7).velocity.y, -1);
}

TEST_F(BesideTest, ForgetsMissedContactsWhenVerticesHaveOtherNumbers) {
  session.simulation.set_beside(by_paper(0.02f));
  run(session, 30);
  const auto& missed = session.simulation.beside()->figures(Half::second).missed();
  ASSERT_FALSE(missed.empty());
  session.simulation.clock.paused = true;
  session.bodies.select(0);
  session.bodies.remove_selected();
  EXPECT_TRUE(missed.empty());
  EXPECT_EQ(totals(Half::second).frames, 30);
  session.simulation.clock.single_step();
  session.advance(tick);
  ASSERT_EQ(world(Half::second).bodies().count(), 1u);
  undo(session.simulation);
  EXPECT_TRUE(missed.empty());
}

TEST_F(BesideTest, ForgetsWhatTheOracleSawInASecondWorldThatHasEnded) {
  session.surfaces_beside.on = true;
  session.simulation.set_beside(by_paper(0.02f));
  ASSERT_TRUE(wait_until([this] {
    session.advance(tick);
    return session.surfaces_beside.report().id != 0;
  }));
  toggle_beside(session.simulation);
  session.surfaces_beside.on = false;  // as carry_out() does
  session.advance(tick);
  EXPECT_EQ(session.surfaces_beside.report().id, 0u);
}

TEST_F(BesideTest, GoesBackAndForthWithTheFirst) {
  session.simulation.set_beside(by_paper(0.1f));
  run(session, 30);
  const std::uint64_t first = hash(Half::first), second = hash(Half::second);
  session.bodies.drop();
  run(session, 20);
  undo(session.simulation);
  EXPECT_EQ(hash(Half::first), first);
  EXPECT_EQ(hash(Half::second), second);
  EXPECT_EQ(totals(Half::second).frames, 30) << "figures go back, too";
  redo(session.simulation);
  expect_same_numbers();
  session.simulation.rewind_to(30);
  EXPECT_EQ(world(Half::second).frame(), session.world().frame());
  session.simulation.rewind_to(10);
  const std::uint64_t there = hash(Half::second);
  session.simulation.clock.paused = false;
  run(session, 30);
  session.simulation.rewind_to(10);
  EXPECT_EQ(hash(Half::second), there);
  EXPECT_EQ(world(Half::second).collision().cell_size, glm::vec3(0.1f));
  session.simulation.reset();
  EXPECT_EQ(world(Half::second).frame(), 0);
  EXPECT_EQ(totals(Half::second).frames, 0);
  EXPECT_EQ(world(Half::second).method().key, collide::paper_method);
}

TEST_F(BesideTest, ChangesOnlyTheHalfWhoseSettingsAreEdited) {
  session.simulation.set_beside(by_paper(0.1f));
  const auto set_level = [this](int level) {
    session.simulation.change_scene("Subdivision", [level](softbody::Scene& s) { s.collision.levels = level; });
  };
  set_level(2);
  EXPECT_EQ(world(Half::second).collision().levels, 2) << "where they do not differ, the second follows";
  session.simulation.edits = Half::second;
  set_level(6);
  session.simulation.change_scene("Gravity", [](softbody::Scene& s) { s.gravity = {0, -1, 0}; });
  session.settings.set_integrator({"rk4", {}});
  EXPECT_EQ(world(Half::first).collision().levels, 2);
  EXPECT_EQ(world(Half::second).collision().levels, 6);
  EXPECT_EQ(world(Half::first).scene().gravity.y, -1) << "the world is the same";
  EXPECT_EQ(world(Half::second).scene().gravity.y, -1);
  EXPECT_EQ(world(Half::first).integrator_choice(), softbody::IntegratorChoice{});
  EXPECT_EQ(world(Half::second).integrator_choice().key, "rk4");
  undo(session.simulation);
  EXPECT_EQ(world(Half::second).integrator_choice(), softbody::IntegratorChoice{});
  session.simulation.edits = Half::first;
  set_level(4);
  EXPECT_EQ(world(Half::second).collision().levels, 6);
}

TEST_F(BesideTest, StopsTheHalfThatBlowsUpAlone) {
  softbody::Scene stiff = touching_pair();
  stiff.materials[0][softbody::StructuralSprings::stiffness] = 20'000;
  for (const Half unstable : {Half::first, Half::second}) {
    Session two(stiff, {}, 1);
    const softbody::IntegratorChoice good, bad{"explicit-euler", 1};
    two.settings.set_integrator(unstable == Half::first ? bad : good);
    two.simulation.set_beside(compare::HowSimulated{stiff, unstable == Half::first ? good : bad});
    run(two, 120);
    const auto frame = [&](Half half) { return two.simulation.world(half).frame(); };
    const Half stable = unstable == Half::first ? Half::second : Half::first;
    EXPECT_EQ(frame(stable), 120);
    EXPECT_LT(frame(unstable), 100);
    EXPECT_EQ(unstable == Half::second, !two.simulation.beside()->stopped().empty());
    EXPECT_EQ(unstable == Half::first, two.simulation.stability().blow_up().has_value());
    EXPECT_FALSE(two.simulation.clock.paused);
    EXPECT_EQ(two.simulation.before_last_step(unstable).simulated().x[0],
              two.simulation.world(unstable).simulated().positions.x[0])
        << "no picture shows it on its way";
    if (unstable == Half::first) continue;
    two.simulation.edits = Half::second;
    two.settings.set_integrator({"rk4", {}});
    run(two, 1);
    EXPECT_EQ(frame(unstable), 121) << "another setting starts it anew beside the first";
  }
}

TEST_F(BesideTest, IsAtRestWhenBothHalvesHaveStopped) {
  softbody::Scene stiff = touching_pair();
  stiff.materials[0][softbody::StructuralSprings::stiffness] = 20'000;
  Session two(stiff, {}, 1);
  two.settings.set_integrator({"explicit-euler", 1});
  two.simulation.set_beside(compare::HowSimulated{stiff, {"explicit-euler", 2}});
  run(two, 120);
  ASSERT_FALSE(stopped(two.simulation, Half::first).empty());
  ASSERT_FALSE(stopped(two.simulation, Half::second).empty());
  EXPECT_TRUE(two.simulation.all_at_rest());
}

TEST_F(BesideTest, LetsBodiesComeIntoTheHalfThatGoesOn) {
  softbody::Scene scene = touching_pair();
  scene.materials[0][softbody::StructuralSprings::stiffness] = 20'000;
  scene.bodies.push_back(scene.bodies.back());
  scene.bodies.back().position = {8, 1, 0};
  scene.bodies.back().appear = 100;
  Session two(scene, {}, 1);
  two.settings.set_integrator({"explicit-euler", 1});
  two.simulation.set_beside(compare::HowSimulated{scene, {}});
  run(two, 120);
  const auto bodies = [&](Half half) { return two.simulation.world(half).bodies().count(); };
  ASSERT_EQ(bodies(Half::first), 2u);
  ASSERT_EQ(bodies(Half::second), 3u);
  two.simulation.change_scene("Gravity", [](softbody::Scene& s) { s.gravity = {0, -1, 0}; });
  EXPECT_EQ(bodies(Half::second), 3u);

  ui::UiState ui;
  engine::Camera camera;
  ui.beside_as_ghost = true;
  EXPECT_FALSE(window::scene_picture(two, ui, camera, 1).ghost) << "the worlds have other bodies";
  ui.beside_as_ghost = false;
  constexpr glm::ivec2 size{800, 600};
  camera.set_orbit({glm::vec3(centre(two.simulation.world(Half::second), 2)), 4});
  window::SceneMouse mouse;
  const window::MouseInput press{.at = {600, 300}, .down = {true}};
  for (const auto& input : {window::MouseInput{.at = press.at}, press})
    ui::carry_out(mouse.update(input, two, ui, camera, size), two, ui);
  EXPECT_FALSE(grabbed(two.simulation)) << "the first half lacks this body";
  EXPECT_FALSE(two.bodies.selected());
}

TEST_F(BesideTest, IsRefusedWhereItsIntegratorCannotMoveTheBodies) {
  softbody::Scene scene = touching_pair();
  scene.bodies[0].mesh.subdivisions = 4;
  Session large(scene, {}, 1);
  large.simulation.set_beside(compare::HowSimulated{scene, {"implicit", {}}});
  EXPECT_FALSE(large.simulation.beside());
  EXPECT_NE(large.simulation.notice.text().find("too large a matrix"), std::string::npos)
      << large.simulation.notice.text();
}

TEST(Difference, NamesWhatDiffersAndLeavesTheRestToTheFirst) {
  HowSimulated first = by_paper(0.1f), second = by_paper(0.25f);
  second.scene.collision.levels = 5;
  second.scene.gravity.y = 7;
  second.integrator = {"rk4", 8};
  const compare::Difference difference(first, second);
  EXPECT_EQ(difference.text(second), "level 5, cells of 0.25 m, Runge-Kutta 4, 8 substeps");
  EXPECT_EQ(difference.text(first), "level 3, cells of 0.1 m, Auto");
  first.scene.collision.buckets = 77;
  const HowSimulated beside = difference.applied_to(first);
  EXPECT_EQ(beside.scene.collision.buckets, 77u);
  EXPECT_EQ(beside.scene.collision.levels, 5);
  EXPECT_EQ(beside.scene.gravity, first.scene.gravity);
  EXPECT_EQ(beside.integrator, second.integrator);
  EXPECT_EQ(compare::Difference(first, first).text(first), "the same settings");
}

TEST(BesidePanel, BeginsAndEndsTheSecondWorldAndChoosesWhoseSettingsItShows) {
  PanelRig rig;
  rig.click("A second world beside it");
  rig.frames(3);  // the strip finds its height
  ASSERT_TRUE(rig.session.simulation.beside());
  EXPECT_EQ(rig.session.simulation.world(Half::second).method().key, collide::paper_method);
  rig.click("Right half");
  const int before = rig.session.world().collision().levels;
  rig.drag("Level", 60);
  EXPECT_EQ(rig.session.world().collision().levels, before);
  EXPECT_GT(rig.session.simulation.world(Half::second).collision().levels, before);
  rig.click("Ghost");
  EXPECT_TRUE(rig.ui.beside_as_ghost);
  rig.click("Close beside");
  EXPECT_FALSE(rig.session.simulation.beside());
  toggle_beside(rig.session.simulation);
  EXPECT_EQ(rig.session.simulation.edits, Half::first);
}

}  // namespace THIS_FILE
}  // namespace app
