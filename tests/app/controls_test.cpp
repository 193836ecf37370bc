// What the user does with bodies, settings and scenes.

#include <gtest/gtest.h>

#include <functional>

#include <glm/geometric.hpp>

#include "app/session/session.h"
#include "softbody/mesh/limits.h"
#include "softbody/model/body_model.h"
#include "tests/app/scenes.h"
#include "tests/temporary_folder.h"

namespace app {
namespace THIS_FILE {

TEST(BodyControls, ThrowABodyToWhereTheyAimAgainstGravity) {
  softbody::Scene scene = without_solids();
  scene.gravity = {0, -9.81, 0};
  const glm::dvec3 eye(0, 8, 0), target(9, 6, 3);
  for (const double speed : {2.0, 12.0, 25.0}) {  // the first is too slow to get there
    session::Simulation simulation(scene, 1);
    session::BodyControls bodies(simulation);
    bodies.throw_speed = speed;
    bodies.throw_body(eye, target);
    double closest = 1e9;
    for (int i = 0; i < 120; ++i) {
      simulation.advance(tick);
      closest = std::min(closest, glm::distance(centre(simulation.world(), 2), target));
    }
    EXPECT_LT(closest, 0.4) << speed;
  }
}

TEST(BodyControls, ThrowABodyAsFastAsAsked) {
  session::Simulation simulation(without_solids(), 1);
  session::BodyControls bodies(simulation);
  bodies.throw_speed = 12;
  const glm::dvec3 direction = glm::normalize(glm::dvec3(1, 0.5, 0));
  bodies.throw_body({0, 8, 0}, glm::dvec3(0, 8, 0) + 3.0 * direction);
  ASSERT_EQ(simulation.world().bodies().count(), 3u);
  EXPECT_EQ(bodies.selected(), 2u);
  const glm::dvec3 from = centre(simulation.world(), 2);
  for (int i = 0; i < 30; ++i) simulation.advance(tick);
  EXPECT_LT(glm::distance(centre(simulation.world(), 2), from + 6.0 * direction), 1e-3);
}

TEST(BodyControls, SayThatABodyHasNoRoomAndDoNotPause) {
  softbody::Scene scene = without_solids();
  add_solid(scene, {softbody::SolidSphere{.centre = {0, 50, 0}, .radius = 30}});
  session::Simulation simulation(scene, 1);
  session::BodyControls bodies(simulation);
  const int too_many = 1 + static_cast<int>(softbody::max_particles / simulation.world().model(0).mesh.vertices.size());
  const std::vector<std::function<void()>> changes{[&] {
                                                     bodies.throw_body({0, 50, 0}, {0, 50, 1});
                                                   },
                                                   [&] { bodies.drop(too_many); }};
  for (const auto& change : changes) {
    simulation.notice.clear();
    change();
    EXPECT_NE(simulation.notice.text().find("no room"), std::string::npos) << simulation.notice.text();
    EXPECT_EQ(simulation.world().bodies().count(), 2u);
    EXPECT_FALSE(simulation.clock.paused);
  }
}

TEST(BodyControls, DropABodyAlsoWhereTheSceneDoesNotSayWhere) {
  softbody::Scene scene = touching_pair();
  for (const std::size_t bodies : {3, 3, 0}) {
    session::Simulation simulation(scene, 1);
    session::BodyControls controls(simulation);
    EXPECT_EQ(controls.can_drop(), bodies > 0);
    controls.drop();
    EXPECT_EQ(simulation.world().bodies().count(), bodies);
    if (!scene.dropper) scene.bodies.clear();
    scene.dropper.reset();
  }
}

TEST(BodyControls, AskForASelectionBeforeTheyDelete) {
  session::Simulation simulation(touching_pair(), 1);
  session::BodyControls bodies(simulation);
  bodies.remove_selected();
  ASSERT_NE(simulation.notice.text().find("click a body"), std::string::npos);
  bodies.select(7);
  EXPECT_FALSE(bodies.selected());
  bodies.select(0);
  EXPECT_TRUE(simulation.notice.text().empty());
  bodies.remove_selected();
  EXPECT_EQ(simulation.world().bodies().count(), 1u);
  EXPECT_FALSE(bodies.selected());
}

TEST(SettingControls, KeepGravityMaterialAndSolidsOverAResetUntilTheScenesAreRestored) {
  session::Simulation simulation(touching_pair(), 1);
  session::SettingControls controls(simulation);
  const auto expect = [&](double mass, double gravity, bool enabled) {
    const softbody::Scene& scene = simulation.world().scene();
    EXPECT_EQ(scene.materials[0][softbody::Material::mass], mass);
    EXPECT_EQ(scene.gravity, glm::dvec3(0, gravity, 0));
    ASSERT_EQ(scene.solids.size(), 2u);
    EXPECT_EQ(scene.solids[0].enabled, enabled);
  };
  simulation.change_scene("Material", [](softbody::Scene& s) { s.materials[0][softbody::Material::mass] = 3; });
  simulation.change_scene("Gravity", [](softbody::Scene& s) { s.gravity = {0, -2, 0}; });
  softbody::Solid solid = simulation.world().scene().solids[0];
  solid.enabled = false;
  controls.set_solid(0, solid);
  expect(3, -2, false);
  simulation.reset();
  expect(3, -2, false);
  controls.restore_world();
  expect(1, -9.81, true);
}

TEST(SettingControls, FindNewContactsWhilePaused) {
  session::Simulation simulation(touching_pair(), 1);
  simulation.clock.paused = true;
  const auto before = simulation.world().detection().contacts.size();
  const auto revision = simulation.revision();
  simulation.change_scene("Settings", [](softbody::Scene& s) { s.collision.tolerance = 0.2f; });
  EXPECT_TRUE(simulation.notice.text().empty());
  EXPECT_GT(simulation.world().detection().contacts.size(), before);
  EXPECT_NE(simulation.revision(), revision);
}

TEST(SettingControls, GoThroughTheGivenMethods) {
  session::Simulation simulation(touching_pair(), 1);
  session::SettingControls controls(simulation);
  for (const compare::MethodSet& methods : {compare::all_methods(), compare::usual_methods()}) {
    compare::MethodSet seen(methods.size(), false);
    for (auto left = std::ranges::count(methods, true); left > 0; --left) {
      controls.next_method(methods);
      simulation.advance(tick);
      EXPECT_TRUE(simulation.notice.text().empty());
      seen[compare::method_index(simulation.world().method().key)] = true;
    }
    EXPECT_EQ(seen, methods);
  }
  controls.set_method("octree");
  controls.next_method(compare::MethodSet(collide::method_table().size(), false));
  EXPECT_EQ(simulation.world().method().key, "octree") << "there is no other";
  controls.set_method("no-such-method");
  EXPECT_EQ(simulation.world().method().key, "octree");
}

TEST(SettingControls, LeaveOutAMethodThatWouldTakeTooLong) {
  softbody::Scene scene = touching_pair();
  scene.bodies.pop_back();
  scene.bodies[0].mesh.subdivisions = 4;
  for (int i = 1; i < 18; ++i) {  // 46,116 vertices are more than a billion pairs
    scene.bodies.push_back(scene.bodies[0]);
    scene.bodies.back().position.x += 2.0 * i;
  }
  session::Simulation simulation(scene, 1);
  session::SettingControls controls(simulation);
  const std::string first(simulation.world().method().key);
  controls.set_method("brute-force");
  EXPECT_EQ(simulation.world().method().key, first);
  EXPECT_NE(simulation.notice.text().find("too long to drive"), std::string::npos) << simulation.notice.text();
  for (std::size_t i = 0; i < collide::method_table().size(); ++i) {
    controls.next_method(compare::all_methods());
    EXPECT_NE(simulation.world().method().key, "brute-force");
  }
}

TEST(SceneControls, KeepTheSceneWhenAnotherCannotBeLoaded) {
  session::Simulation simulation(touching_pair(), 1);
  session::SceneControls scenes(simulation, {});
  scenes.choose("no-such-scene.toml");
  EXPECT_NE(simulation.notice.text().find("no-such-scene"), std::string::npos);
  EXPECT_EQ(simulation.world().scene().key, "pair");
}

TEST(SceneControls, SayThatThePresetsAreDamaged) {
  const tests::TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "scenes");
  session::Simulation simulation(touching_pair(), 1);
  const session::SceneControls without(simulation, folder.path() / "scenes");
  EXPECT_EQ(simulation.notice.text(), "") << "only a scene that names a preset needs the file";
  const auto file = folder.write("materials.toml", "[[material]\n");
  ASSERT_EQ(without.presets_file(), file);
  const session::SceneControls damaged(simulation, folder.path() / "scenes");
  EXPECT_TRUE(damaged.presets().empty());
  EXPECT_TRUE(simulation.notice.is_error());
  EXPECT_NE(simulation.notice.text().find("materials.toml"), std::string::npos) << simulation.notice.text();
  session::SettingControls(simulation).set_integrator(simulation.simulated()->integrator_choice());
  EXPECT_TRUE(simulation.notice.is_error()) << "a choice that changes nothing leaves the notice";
}

TEST(MovedSolid, KeepsItsShapeAndItsFirstPlaceWithinTheLimits) {
  const auto place_of = [](softbody::Solid solid, const glm::dvec3& by) {
    std::vector<glm::dvec3> places;
    session::moved(solid, by).values([&]<class Value>(const char*, Value value) {
      if constexpr (std::is_same_v<Value, softbody::solid::Place>) places.push_back(value.value);
    });
    return places;
  };
  using Places = std::vector<glm::dvec3>;
  EXPECT_EQ(place_of({softbody::SolidSphere{}}, {1, 2, 3}), (Places{{1, 2, 3}}));
  EXPECT_EQ(place_of({softbody::SolidBox{}}, {0, 1e3, 0}), (Places{{0, session::max_solid_coordinate, 0}}));
  EXPECT_EQ(place_of({softbody::SolidCapsule{}}, {1, 2, 3}), (Places{{0.5, 2, 3}, {1.5, 2, 3}}));
  EXPECT_EQ(place_of({softbody::SolidCapsule{}}, {1e3, 0, 0}), (Places{{20, 0, 0}, {21, 0, 0}}));
  EXPECT_EQ(place_of({softbody::SolidSphere{.centre = {50, 0, 0}}}, {-1, 0, 0}), (Places{{49, 0, 0}}))
      << "it may come back";
}

TEST(SolidList, NamesSolidsApartAndListsThoseWithoutAnEndLast) {
  using namespace softbody;
  const std::vector<softbody::Solid> solids{{SolidSphere()}, {Ground()},   {SolidPlane()},
                                            {SolidBox()},    {SolidBox()}, {SolidCapsule()}};
  std::vector<std::string> names;
  for (const std::size_t i : session::listed(solids)) names.push_back(session::solid_name(solids, i));
  EXPECT_EQ(names, (std::vector<std::string>{"Sphere", "Box 1", "Box 2", "Capsule", "Plane", "Ground"}));
}

}  // namespace THIS_FILE
}  // namespace app
