// Bodies against the ground and the solid sphere: nothing goes in, and what starts inside comes out gently.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/softbody/helpers.h"
#include "tests/support/world_test_access.h"

namespace softbody::test {
namespace THIS_FILE {

Scene falling(const glm::dvec3& position, const glm::dvec3& velocity) {
  Scene scene = lone_body(gas_ball(), velocity);
  scene.gravity = {0, -9.81, 0};
  scene.bodies[0].position = position;
  return scene;
}

TEST(Solids, KeepParticlesOutToTenMicrometresInAFall) {
  for (const double speed : {0.0, 10.0, 50.0}) {
    Scene scene = falling({0.1, 4, 0.05}, {0, -speed, 0});
    set_solid(scene, {SolidSphere{.centre = {0, 1, 0}}});
    set_solid(scene, {Ground{}});
    World world(scene, {});
    std::size_t touched = 0;
    for (int i = 0; i < 240; ++i) {
      world.step();
      ASSERT_LT(measure(world).deepest_penetration, 1e-5) << "frame " << i << " at " << speed << " m/s";
      touched += solid_contacts(world).size();
    }
    EXPECT_GT(touched, 100u);
  }
}

/// Its narrow walls push what falls in from one to the other: they are asked in turn until neither is entered.
TEST(Solids, PushNoParticleThroughTheOtherWallOfAGroove) {
  Scene scene = sheet_on_ground(0, {0, -9.81, 0}, {0.5, -5, 0});
  remove_solids<Ground>(scene);
  scene.bodies[0].position = {0, 0.3, 0};
  scene.bodies[0].mesh.width = 0.01;
  for (const double side : {-1.0, 1.0})
    add_solid(scene, {SolidPlane{.normal = glm::normalize(glm::dvec3(side, 0.5, 0))}});
  World world(scene, {});
  double deepest = 0;
  std::size_t touched = 0;
  for (int i = 0; i < 60; ++i) {
    world.step();
    deepest = std::max(deepest, measure(world).deepest_penetration);
    touched += solid_contacts(world).size();
  }
  EXPECT_LT(deepest, 2e-4);
  EXPECT_GT(touched, 100u);
}

TEST(Solids, StopABodyThatFallsOntoThemWithinOneFrame) {
  Scene scene = falling({0, 0.6, 0}, glm::dvec3(0.0));
  scene.gravity = {0, -1000, 0};
  set_solid(scene, {Ground{}});
  World world(scene, {});
  world.step();
  EXPECT_LT(measure(world).deepest_penetration, 1e-5);
  EXPECT_FALSE(solid_contacts(world).empty()) << "it got there";
}

TEST(Solids, HoldABodysWeight) {
  Scene scene = falling({0, 2.52, 0}, glm::dvec3(0.0));
  scene.materials[0][Material::internal_damping] = 20;
  scene.materials[0][contact::rebound_speed] = 1;
  scene.materials[0][contact::rolling_resistance] = 0.3;
  set_solid(scene, {Ground{2.0}, 0.6});
  World world(scene, {});
  run(world, 600);
  const Motion m = motion(world, 0);
  EXPECT_LT(glm::length(m.velocity), 2e-3);
  EXPECT_GT(m.centre.y, 2.4);
  EXPECT_LT(m.centre.y, 2.52);
  // What the ground gives in a frame is the weight times its length.
  glm::dvec3 impulse(0.0);
  for (int i = 0; i < 60; ++i) {
    world.step();
    impulse += WorldTestAccess::solid_impulse(world, 0);
  }
  EXPECT_NEAR(impulse.y, 9.81, 0.02);
  EXPECT_NEAR(std::hypot(impulse.x, impulse.z), 0, 1e-9) << "only along the normal";
}

TEST(Solids, KeepParticlesOfAThickMaterialAtADistance) {
  for (const double thickness : {0.03, 0.2})
    for (const bool flat : {true, false}) {
      Scene scene = falling({0, 2.57 + thickness, 0}, glm::dvec3(0.0));
      scene.materials[0][Material::thickness] = thickness;
      if (flat)
        set_solid(scene, {Ground{2}});
      else
        set_solid(scene, {SolidSphere{.centre = {0, 1, 0}}});
      World world(scene, {});
      double nearest = 1;
      for (int i = 0; i < 60; ++i) {
        world.step();
        for (const Particle& p : particles_of(world))
          nearest = std::min(nearest, -solid_depth(scene, p.position).depth);
      }
      EXPECT_NEAR(nearest, thickness, 1e-5) << (flat ? "on the ground" : "on a sphere");
    }
  Scene scene = sheet_on_ground(0.5, {0, -9.81, 0}, glm::dvec3(0.0));
  scene.materials[0][Material::thickness] = 0.03;
  scene.bodies[0].position.y = 0.2;
  World fallen(scene, {});
  run(fallen, 60);
  EXPECT_NEAR(motion(fallen, 0).centre.y, 0.03, 1e-5);
  EXPECT_EQ(solid_contacts(fallen).size(), 25u) << "near is touching";
  EXPECT_EQ(measure(fallen).deepest_penetration, 0);
}

TEST(Solids, ContactsAreTheParticlesOnASurfaceWithItsNormal) {
  World world(sheet_on_ground(0.5, {0, -9.81, 0}, glm::dvec3(0.0)), {});
  const auto contacts = solid_contacts(world);
  ASSERT_EQ(contacts.size(), 25u);
  for (std::size_t i = 0; i < 25; ++i) {
    EXPECT_EQ(contacts[i].vertex, i);
    EXPECT_EQ(contacts[i].normal, glm::vec3(0, 1, 0));
  }
}

/// All kinds of solids and 20 balls, of which some lie deep in solids, some touch one, and most are far from all.
TEST(Solids, AreMeasuredAtAllParticlesThatTheyReach) {
  Scene scene = lone_body(gas_ball(), glm::dvec3(0.0));
  set_solid(scene, {Ground{}});
  set_solid(scene, {SolidSphere{.centre = {0, 1, 0}, .radius = 1.5}});
  set_solid(scene, {SolidPlane{.point = {9, 0, 0}, .normal = {-1, 0, 0}}});
  set_solid(scene, {SolidBox{.centre = {-5, 2, 3}, .half_size = {1, 0.7, 2}}});
  set_solid(scene, {SolidCapsule{.from = {3, 3, 3}, .to = {6, 3, 3}, .radius = 0.4}});
  scene.bodies[0].position = {8.502, 5, 0};
  std::mt19937 random(3);
  for (int i = 1; i < 20; ++i) add_body(scene, glm::dvec3(0, 4.5, 0) + random_vector(random, 8), glm::dvec3(0.0));
  const World world(scene, {});
  std::vector<Index> touched;
  double deepest = 0;
  const double least = -world.model(0).material[Material::thickness] - 1e-4;
  for (BodyId body = 0; body < 20; ++body)
    for (Index i = 0; i < 162; ++i) {
      const double depth = solid_depth(scene, world.particle(body, i).position).depth;
      if (depth > least) touched.push_back(body * 162 + i);
      deepest = std::max(deepest, depth);
    }
  ASSERT_GT(touched.size(), 50u);
  ASSERT_LT(touched.size(), 2000u);
  EXPECT_EQ(measure(world).deepest_penetration, deepest);
  std::vector<Index> found;
  for (const SolidContactPoint& contact : solid_contacts(world)) found.push_back(contact.vertex);
  EXPECT_EQ(found, touched);
}

TEST(SolidDepth, IsTheDeepestOfAllSolids) {
  Scene scene;
  EXPECT_EQ(solid_depth(scene, {1, 2, 3}).depth, -std::numeric_limits<double>::infinity());
  set_solid(scene, {Ground{0.5}, 0});
  set_solid(scene, {SolidSphere{.centre = {0, 1, 0}, .radius = 2}});
  add_solid(scene, {SolidSphere{.centre = {10, 0, 0}, .radius = 1}});
  EXPECT_NEAR(solid_depth(scene, {20, 0.2, 0}).depth, 0.3, 1e-12);
  EXPECT_NEAR(solid_depth(scene, {0, 2.5, 0}).depth, 0.5, 1e-12);
  scene.solids[1].enabled = false;
  EXPECT_NEAR(solid_depth(scene, {10, 0.25, 0}).depth, 0.25, 1e-12) << "of the ground alone";
  EXPECT_NEAR(solid_depth(scene, {0, 4, 0}).depth, -1, 1e-12);
  const SolidDepth side = solid_depth(scene, {1.5, 1, 0});
  EXPECT_NEAR(side.depth, 0.5, 1e-12);
  EXPECT_NEAR(glm::distance(side.normal, glm::vec3(1, 0, 0)), 0, 1e-6);
  EXPECT_EQ(solid_depth(scene, {0, 1, 0}).normal, glm::vec3(0, 1, 0)) << "the very centre: out is up";
}

}  // namespace THIS_FILE
}  // namespace softbody::test
