// What hands do to the world, and what can be taken back.

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "softbody/limits.h"
#include "softbody/prototype.h"
#include "tests/app/hands.h"

namespace app {
namespace {

TEST(Hands, AThrownBodyFliesAsFastAsAsked) {
  Session session(without_solids(), {}, 1);
  session.throw_speed = 12;
  const glm::dvec3 direction = glm::normalize(glm::dvec3(1, 0.5, 0));
  session.throw_body({0, 8, 0}, direction);
  ASSERT_EQ(session.world().bodies().count(), 3u);
  EXPECT_EQ(session.selected_body(), 2u);
  const glm::dvec3 from = centre(session.world(), 2);
  for (int i = 0; i < 30; ++i) session.advance(tick);
  EXPECT_LT(glm::distance(centre(session.world(), 2), from + 6.0 * direction), 1e-3);
}

TEST(Hands, AThrowWithoutRoomIsRefused) {
  softbody::Scene scene = without_solids();
  scene.spheres.push_back({.centre = {0, 50, 0}, .radius = 30});
  Session session(scene, {}, 1);
  session.throw_body({0, 50, 0}, {0, 0, 1});
  EXPECT_EQ(session.world().bodies().count(), 2u);
  EXPECT_NE(session.notice().find("room"), std::string::npos);
  EXPECT_FALSE(session.paused);
}

TEST(Hands, ADropThatIsRefusedDoesNotPause) {
  Session session(touching_pair(), {}, 1);
  session.drop(1 + static_cast<int>(softbody::max_particles / session.world().prototype(0).mesh.vertices.size()));
  EXPECT_NE(session.notice().find("no room"), std::string::npos) << session.notice();
  EXPECT_EQ(session.world().bodies().count(), 2u);
  EXPECT_FALSE(session.paused);
}

TEST(Hands, DeletingForgetsWhatWasFoundOfTheBodiesThatThereWere) {
  Session session(touching_pair(), {}, 1);
  session.remove_selected();
  EXPECT_NE(session.notice().find("click a body"), std::string::npos);
  session.select_body(7);
  EXPECT_FALSE(session.selected_body());
  session.select_body(0);
  session.remove_selected();
  EXPECT_TRUE(session.notice().empty());
  EXPECT_EQ(session.world().bodies().count(), 1u);
  EXPECT_FALSE(session.selected_body());
  EXPECT_EQ(session.missed(), nullptr);
  EXPECT_EQ(session.before_last_step().x.size(), session.world().positions().x.size());
  for (int i = 0; i < 5; ++i) session.advance(tick);
}

TEST(Hands, WhatTheWorldRefusesIsSaidAndChangesNothing) {
  softbody::Scene scene = touching_pair();
  scene.contact_surface = softbody::ContactSurface::surfaces;  // for which no implicit step is in reserve
  Session session(scene, {}, 1);
  softbody::Material stiff = session.world().scene().materials[0];
  stiff.structural.stiffness = 1e9;
  session.set_material(0, stiff);
  EXPECT_NE(session.notice().find("stiff"), std::string::npos);
  EXPECT_FALSE(session.paused);
  EXPECT_EQ(session.world().scene().materials[0].structural.stiffness, softbody::Material().structural.stiffness);
}

TEST(Hands, ResetKeepsGravityMaterialAndSolidsAndTheScenesWorldBringsTheirsBack) {
  Session session(touching_pair(), {}, 1);
  softbody::Material heavy = session.world().scene().materials[0];
  heavy.mass = 3;
  session.set_material(0, heavy);
  session.set_gravity(2);
  SolidList solids = session.solids();
  ASSERT_EQ(solids.size(), 2u);
  solids[0].on = false;
  session.set_solids(solids);
  EXPECT_TRUE(session.world().scene().spheres.empty());
  session.reset();
  EXPECT_EQ(session.world().scene().materials[0].mass, 3);
  EXPECT_EQ(session.world().scene().gravity, glm::dvec3(0, -2, 0));
  EXPECT_TRUE(session.world().scene().spheres.empty());
  ASSERT_EQ(session.solids().size(), 2u);
  session.restore_world_settings();
  EXPECT_EQ(session.world().scene().materials[0].mass, 1);
  EXPECT_EQ(session.world().scene().gravity, glm::dvec3(0, -9.81, 0));
  EXPECT_EQ(session.world().scene().spheres.size(), 1u);
  EXPECT_TRUE(session.solids()[0].on);
}

TEST(Undo, BringsTheWorldBackToTheBitAndItGoesOnAsIfNothingHadBeen) {
  Session session(touching_pair(), {}, 1), undisturbed(touching_pair(), {}, 1);
  EXPECT_FALSE(session.can_undo());
  for (Session* s : {&session, &undisturbed}) {
    s->drop();
    for (int i = 0; i < 20; ++i) s->advance(tick);
  }
  const std::uint64_t before = session.world().state_hash();
  session.reset();
  for (int i = 0; i < 5; ++i) session.advance(tick);
  ASSERT_NE(session.world().state_hash(), before);
  ASSERT_TRUE(session.can_undo());
  session.undo();
  EXPECT_EQ(session.world().state_hash(), before);
  for (Session* s : {&session, &undisturbed})
    for (int i = 0; i < 20; ++i) s->advance(tick);
  EXPECT_EQ(session.world().frame(), undisturbed.world().frame());
  EXPECT_EQ(session.world().state_hash(), undisturbed.world().state_hash());
}

TEST(Undo, TakesADropAndAThrowBackToTheBit) {
  Session session(touching_pair(), {}, 1);
  for (int i = 0; i < 10; ++i) session.advance(tick);
  const std::uint64_t before = session.world().state_hash();
  session.grab({.body = 0, .target = {0, 4, 0}});
  session.drop(20);
  EXPECT_TRUE(session.world().grabbed()) << "a drop does not make the hand let go";
  session.throw_body({0, 3, 9}, {0, 0, -1});
  ASSERT_EQ(session.world().bodies().count(), 23u);
  session.advance(tick);
  session.undo();
  EXPECT_EQ(session.world().bodies().count(), 22u);
  session.undo();
  EXPECT_EQ(session.world().bodies().count(), 2u);
  EXPECT_EQ(session.world().state_hash(), before);
  EXPECT_FALSE(session.world().grabbed());
  session.pull_to({9, 9, 9});  // nothing to pull
  EXPECT_FALSE(session.world().grabbed());
  EXPECT_FALSE(session.can_undo());
}

TEST(Undo, LeavesTheSettingsInUseAlone) {
  Session session(touching_pair(), {}, 1);
  session.drop();
  session.set_method("grid-hash");
  session.set_gravity(1.5);
  session.undo();
  EXPECT_EQ(session.world().bodies().count(), 2u);
  EXPECT_EQ(session.world().method().key, "grid-hash");
  EXPECT_DOUBLE_EQ(glm::length(session.world().scene().gravity), 1.5);
}

TEST(Undo, HasNothingToTakeBackWhereNothingCame) {
  Session session(touching_pair(), {}, 1);
  const glm::dvec3 inside(0, 0, 0);  // of the solid sphere
  session.throw_body(inside, {0, 0, -1});
  ASSERT_EQ(session.world().bodies().count(), 2u);
  EXPECT_FALSE(session.notice().empty());
  EXPECT_FALSE(session.can_undo());
}

TEST(Undo, BringsADeletedBodyBackToTheBit) {
  Session session(touching_pair(), {}, 1);
  for (int i = 0; i < 10; ++i) session.advance(tick);
  const std::uint64_t before = session.world().state_hash();
  const int frame = session.world().frame();
  session.select_body(0);
  session.remove_selected();
  EXPECT_EQ(session.world().body(0).number, 1u) << "the other one keeps its colour";
  for (int i = 0; i < 10; ++i) session.advance(tick);
  session.reset();  // undone first
  session.undo();
  EXPECT_EQ(session.world().bodies().count(), 1u);
  EXPECT_EQ(session.world().frame(), frame + 10);
  session.undo();
  EXPECT_EQ(session.world().bodies().count(), 2u);
  EXPECT_EQ(session.world().frame(), frame);
  EXPECT_EQ(session.world().state_hash(), before);
  EXPECT_FALSE(session.can_undo());
  session.advance(tick);
  EXPECT_TRUE(session.notice().empty());
}

TEST(Undo, GoesBackOverSeveralResetsAndKeepsTheirSolids) {
  Session session(touching_pair(), {}, 1);
  std::vector<std::uint64_t> hashes;
  for (int i = 0; i < 3; ++i) {
    SolidList solids = session.solids();
    solids[0].on = i % 2;
    session.set_solids(solids);
    for (int k = 0; k < 5 + i; ++k) session.advance(tick);
    hashes.push_back(session.world().state_hash());
    session.reset();
  }
  for (int i = 2; i >= 0; --i) {
    session.undo();
    EXPECT_EQ(session.world().state_hash(), hashes[static_cast<std::size_t>(i)]);
    EXPECT_EQ(session.solids()[0].on, i % 2);
  }
  session.undo();  // nothing left to undo
  EXPECT_EQ(session.world().state_hash(), hashes[0]);
}

TEST(Solids, AreNamedApartAndComeBackAsTheyWere) {
  softbody::Scene scene = touching_pair();
  scene.boxes.resize(2);
  scene.capsules.resize(1);
  scene.planes.resize(1);
  const SolidList list = list_solids(scene);
  ASSERT_EQ(list.size(), 6u);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < list.size(); ++i) names.push_back(solid_name(list, i));
  EXPECT_EQ(names, (std::vector<std::string>{"Sphere", "Box 1", "Box 2", "Capsule", "Plane", "Ground"}));
  softbody::Scene back;
  put_solids(list, back);
  EXPECT_EQ(back.boxes.size(), 2u);
  EXPECT_EQ(back.capsules.size() + back.planes.size() + back.spheres.size(), 3u);
  EXPECT_TRUE(back.ground);
}

}  // namespace
}  // namespace app
