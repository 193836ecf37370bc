// Bodies that start in solids, or that solids are moved onto: they are eased out, whole and without energy from
// nowhere.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "softbody/contact/law.h"
#include "softbody/contact/solid_geometry.h"
#include "softbody/contact/solid_overlap.h"
#include "tests/softbody/surface_rig.h"
#include "tests/support/change.h"

namespace softbody::test {
namespace THIS_FILE {

constexpr double g = 9.81;

/// Whether a body lies in one of the solids so that it is eased out.
bool lies_in_solid(const World& world, BodyId id) {
  std::array<std::vector<float>, 3> at;
  for (const Particle& p : particles_of(world, id))
    for (int k = 0; k < 3; ++k) at[std::size_t(k)].push_back(float(p.position[k]));
  const BodyModel& model = world.model(id);
  const PlacedBody body{*model.surface,
                        glm::dvec3(0.0),
                        {at[0].data(), at[1].data(), at[2].data(), Index(at[0].size())},
                        model.mean_edge};
  return std::ranges::any_of(world.scene().solids, [&](const Solid& solid) {
    return overlap(body, solid, world.scene().contact_surface == ContactSurface::surfaces);
  });
}

struct Case {
  const char* name;
  Solid solid;
  glm::dvec3 position;
  bool sheet = false;
};

const Case cases[]{
    {"BallInASphere", {SolidSphere{.centre = {0, 1, 0}}}, {0.3, 1.2, 0}},
    {"BallInASphereWithoutItsMiddle", {SolidSphere{.centre = {0, 1, 0}, .radius = 1.3}}, {0.3, 1.65, 0.3}},
    {"SphereInABall", {SolidSphere{.centre = {0, 1, 0}, .radius = 0.35}}, {0.05, 1.1, 0.02}},
    {"BallInABox", {SolidBox{.centre = {0, 1, 0}, .half_size = {0.8, 0.7, 0.9}}}, {0.25, 1.1, 0}},
    {"BallOnARod", {SolidCapsule{.from = {-2, 1, 0}, .to = {2, 1.2, 0}, .radius = 0.2}}, {0.3, 1.1, 0.1}},
    {"BallUnderTheGround", {Ground{1}}, {0, 0.6, 0}},
    {"SheetInASphere", {SolidSphere{.centre = {0, 1, 0}, .radius = 0.5}}, {0.03, 1.2, 0.02}, true},
};

class StartInSolid : public testing::TestWithParam<std::tuple<Case, ContactSurface>> {
 protected:
  static Scene scene() {
    const auto& [start, surface] = GetParam();
    Scene scene = ball_in_space(damped(rubber()));
    scene.contact_surface = surface;
    scene.gravity = {0, -g, 0};
    scene.sleep.speed = 0.05;
    set_solid(scene, {Ground{}});
    set_solid(scene, start.solid);
    scene.bodies[0].position = start.position;
    if (start.sheet) {
      scene.bodies[0].mesh = {.kind = "grid", .columns = 10, .rows = 10, .width = 1.6, .depth = 1.6};
      scene.materials[0][GasPressure::inside] = scene.materials[0][GasPressure::outside] = 0;
    }
    return scene;
  }
};

TEST_P(StartInSolid, IsEasedOutWholeAndThenRests) {
  World world(scene(), {});
  ASSERT_TRUE(lies_in_solid(world, 0));
  const auto shape = [&] { return measure(world).energies.elastic + measure(world).energies.gas; };
  const double rest = shape(), start = motion(world, 0).centre.y;
  double highest = start;
  int frames = 0;
  for (; lies_in_solid(world, 0); ++frames) {
    ASSERT_LT(frames, 300);
    world.step();
    ASSERT_FALSE(world.body(0).asleep) << frame_of(world);
    ASSERT_LT(glm::length(motion(world, 0).velocity), law::max_separation_speed + 2 * g / 60) << frame_of(world);
    ASSERT_LT(measure(world).max_speed, 2.5) << frame_of(world);
    ASSERT_LT(shape() - rest, 0.2) << frame_of(world);
  }
  EXPECT_GT(frames, 5);
  // What it has gained is the lift and the speed with which it leaves.
  double least = measure(world).energy;
  for (int i = 0; i < 900 && !world.all_at_rest(); ++i) {
    world.step();
    highest = std::max(highest, motion(world, 0).centre.y);
    ASSERT_LT(measure(world).energy, least + 0.15) << frame_of(world);
    least = std::min(least, measure(world).energy);
  }
  if (world.model(0).mesh.closed) {
    EXPECT_TRUE(world.all_at_rest());
    EXPECT_NEAR(measure(world).volume_ratio_min, 1, 0.05) << "and it is right side out";
    EXPECT_LT(measure(world).deepest_penetration, 1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(All, StartInSolid,
                         testing::Combine(testing::ValuesIn(cases),
                                          testing::Values(ContactSurface::vertices, ContactSurface::surfaces)),
                         [](const auto& i) {
                           return std::string(std::get<0>(i.param).name) +
                                  (std::get<1>(i.param) == ContactSurface::surfaces ? "Surfaces" : "Vertices");
                         });

TEST(SolidOverlap, ASolidThatIsMovedOntoASleeperWakesItAndEasesItOut) {
  for (const char* integrator : {"auto", "implicit", "xpbd"}) {
    Scene scene = ball_in_space(damped(rubber()));
    scene.gravity = {0, -g, 0};
    scene.sleep.speed = 0.05;
    set_solid(scene, {Ground{}});
    scene.bodies[0].position = {0, 0.51, 0};
    scene.contact_surface = ContactSurface::vertices;
    World world(scene, {.integrator = {integrator, {}}});
    run(world, 300);
    ASSERT_TRUE(world.all_at_rest());
    const double volume = measure(world).volume_ratio_min;
    set_solid(scene, {SolidBox{.centre = {0.2, 0.5, 0.1}, .half_size = {0.7, 0.3, 0.5}}});
    world.apply(scene);
    for (int i = 0; i < 200; ++i) {
      world.step();
      ASSERT_LT(measure(world).max_speed, 3.5) << integrator << ", " << frame_of(world);
    }
    EXPECT_FALSE(lies_in_solid(world, 0)) << integrator;
    EXPECT_NEAR(measure(world).volume_ratio_min, volume, 0.05) << integrator;
  }
}

TEST(SolidOverlap, LeavesWhatOnlyTouches) {
  const auto touches = [](const glm::dvec3& at) {
    Scene scene = ball_in_space(rubber());
    scene.bodies[0].position = at;
    set_solid(scene, {SolidSphere{.radius = 1}});
    set_solid(scene, {SolidBox{.centre = {5, 0, 0}, .half_size = {1, 0.01, 1}}});
    set_solid(scene, {SolidCapsule{.from = {10, 0, -1}, .to = {10, 0, 1}, .radius = 0.02}});
    return lies_in_solid(World(scene, {}), 0);
  };
  EXPECT_FALSE(touches({0, 1.51, 0}));
  EXPECT_TRUE(touches({0, 1.44, 0}));
  EXPECT_FALSE(touches({5, 0.56, 0}));
  EXPECT_TRUE(touches({5, 0.4, 0})) << "its edges go through the plate";
  EXPECT_FALSE(touches({10, 0.56, 0}));
  EXPECT_TRUE(touches({10, 0.3, 0})) << "the rod goes through its faces";
}

TEST(OverlappingBodies, AreThoseInSolidsAndInEachOther) {
  Scene scene = ball_in_space(rubber());
  set_solid(scene, {Ground{-3}});
  add_body(scene, {5, 0, 0}, glm::dvec3(0.0));      // apart
  add_body(scene, {0.8, 0, 0}, glm::dvec3(0.0));    // in the first
  add_body(scene, {10, -2.9, 0}, glm::dvec3(0.0));  // in the ground
  add_body(scene, {15, 0, 0}, glm::dvec3(0.0));
  add_body(scene, {15, 0, 0}, glm::dvec3(0.0));  // in one place
  scene.bodies.back().mesh.subdivisions = 3;
  EXPECT_EQ(overlapping_bodies(World(scene, {})), (std::vector<BodyId>{0, 2, 3, 4, 5}));
  scene.bodies.resize(2);
  EXPECT_TRUE(overlapping_bodies(World(scene, {})).empty());
}

TEST(OverlappingBodies, OfOnePlacePartAtABoundedSpeed) {
  Scene scene = ball_in_space(damped(rubber()));
  constexpr int bodies = 6;
  for (int i = 1; i < bodies; ++i) add_body(scene, glm::dvec3(0.0), glm::dvec3(0.0));
  scene.sleep.speed = 0.05;
  World world(scene, {});
  const auto shape = [&] { return measure(world).energies.elastic + measure(world).energies.gas; };
  const double rest = shape();
  for (int i = 0; i < 150; ++i) {
    world.step();
    ASSERT_LT(measure(world).max_speed, 6) << frame_of(world);
    ASSERT_LT(shape() - rest, bodies * 0.5) << frame_of(world);
  }
  EXPECT_TRUE(overlapping_bodies(world).empty());
}

TEST(InteriorOf, HasARectangleASegmentOrAPointInTheMiddle) {
  const auto plate = interior_of(SolidBox{.centre = {1, 2, 3}, .half_size = {0.5, 0.1, 0.7}}).middle;
  EXPECT_NEAR(plate->depth, 0.1, 1e-12);
  EXPECT_NEAR(glm::length(plate->sides[0]), 0.4, 1e-12);
  EXPECT_NEAR(glm::length(plate->sides[1]), 0.6, 1e-12);
  EXPECT_NEAR(plate->sides[0].y, 0, 1e-12);
  EXPECT_NEAR(glm::length(interior_of(SolidBox{.half_size = glm::dvec3(2)}).middle->sides[0]), 0, 1e-12);
  EXPECT_EQ(interior_of(SolidCapsule{.from = {-1, 0, 0}, .to = {3, 0, 0}}).middle->sides[0], glm::dvec3(2, 0, 0));
  EXPECT_FALSE(interior_of(SolidPlane{}).middle);
}

/// A ball so soft that it wraps around the edge holds the middle of the box. It came from outside: contact keeps its
/// particles out, and nothing eases it through the box.
TEST(SolidOverlap, DoesNotEaseABallOutThatWrapsAroundAnEdge) {
  int wrapped = 0;  // frames
  for (const double aside : {0.0, 0.07}) {
    Scene scene = lone_body(gas_ball(0.05), {0, -40, 0});
    scene.gravity = {0, -g, 0};
    scene.materials[0][GasPressure::outside] = 0;
    scene.bodies[0].position = {aside, 2.2, 0};
    const double c = std::sqrt(0.5);
    set_solid(scene, {SolidBox{.half_size = glm::dvec3(1), .axes = glm::dmat3(c, c, 0, -c, c, 0, 0, 0, 1)}});
    World world(scene, {.integrator = {"semi-implicit-euler"}});
    for (int i = 0; i < 180; ++i) {
      world.step();
      ASSERT_LT(measure(world).deepest_penetration, 1e-5) << aside << " m aside, " << frame_of(world);
      wrapped += lies_in_solid(world, 0);
    }
    EXPECT_LT(motion(world, 0).centre.y, -5) << aside << " m aside: it does not come off";
  }
  EXPECT_GT(wrapped, 0);
}

}  // namespace THIS_FILE
}  // namespace softbody::test
