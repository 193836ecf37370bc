// Contact of the true surfaces in whole worlds: conservation laws, and the exact oracle frame by frame.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "collide/surface_oracle.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace {

Material rubber(double friction = 0.5) {
  Material m = gas_ball();
  m.thickness = 0.005;
  m.friction = friction;
  return m;
}

/// One ball of 0.5 m without gravity or solids.
Scene ball_in_space(const Material& material, const glm::dvec3& velocity = glm::dvec3(0.0)) {
  Scene scene = lone_body(material, velocity);
  scene.contact_surface = ContactSurface::surfaces;
  scene.collision.self_collision = true;
  return scene;
}

/// The exact oracle, frame by frame.
class Judge {
 public:
  explicit Judge(const World& world) : world_(world) {
    for (BodyId b = 0; b < world.bodies().count(); ++b) surfaces_.push_back(world.prototype(b).surface);
  }
  /// What overlaps now.
  collide::SurfaceFigures look() {
    return collide::figures_of(world_.positions(), collide::find_overlaps(world_.positions(), surfaces_, workers_));
  }
  void expect_clean(const std::string& when) {
    const collide::SurfaceFigures f = look();
    EXPECT_EQ(f.penetrating_vertices, 0u) << when << ", deepest " << f.deepest;
    EXPECT_EQ(f.piercings, 0u) << when;
  }

 private:
  const World& world_;
  collide::Surfaces surfaces_;
  collide::Workers workers_{1};
};

std::string frame_of(const World& world) { return "frame " + std::to_string(world.frame()); }

/// Two balls that meet off their centres.
Scene glancing(double friction) {
  Scene scene = ball_in_space(rubber(friction), glm::dvec3(3, 0, 0));
  add_body(scene, {1.3, 0.4, 0.1}, {-2, 0, 0.5});
  return scene;
}

TEST(SurfaceContact, KeepsMomentumAndAngularMomentum) {
  for (const double friction : {0.0, 0.5}) {
    World world(glancing(friction), {});
    const glm::dvec3 linear = measure(world).momentum, angular = angular_momentum(world);
    run(world, 60);
    EXPECT_LT(motion(world, 0).velocity.x, 1) << "they met";
    EXPECT_LT(glm::length(measure(world).momentum - linear), 1e-5 * glm::length(linear));
    // Friction's couple over the distance kept, see SurfaceContactRow: 0.0027 of 1.18 N m s.
    EXPECT_LT(glm::length(angular_momentum(world) - angular), (friction > 0 ? 3e-3 : 1e-5) * glm::length(angular));
  }
}

TEST(SurfaceContact, DoesNotActBetweenBodiesThatAreApart) {
  Scene scene = ball_in_space(rubber(), glm::dvec3(3, 0, 0));
  add_body(scene, {0, 1.1, 0}, {-3, 0, 0});
  World world(scene, {});
  run(world, 30);
  EXPECT_NEAR(motion(world, 0).velocity.x, 3, 1e-5);
  EXPECT_NEAR(motion(world, 1).velocity.x, -3, 1e-5);
  EXPECT_NEAR(glm::length(motion(world, 0).spin_momentum), 0, 1e-5);
}

/// A ball thrown down at 100 m/s at something around the origin.
struct Target {
  const char* name;
  bool sheet, held, asleep;
};
void PrintTo(const Target& t, std::ostream* out) { *out << t.name; }

class ThrownBall : public testing::TestWithParam<Target> {
 protected:
  static Scene scene_at(double speed) {
    const Target& target = GetParam();
    Scene scene = ball_in_space(rubber(), {0, -speed, 0});
    scene.bodies[0].position = {0.05, 1.5, 0.03};
    add_body(scene, glm::dvec3(0.0), glm::dvec3(0.0));
    BodySource& other = scene.bodies[1];
    if (target.sheet) other.mesh = {.kind = "grid", .columns = 10, .rows = 10, .width = 2.5, .depth = 2.5};
    if (target.held) other.release = 1000;
    if (target.asleep) {
      scene.sleep = {.speed = 0.03, .frames = 2};
      scene.bodies[0].release = 5;
    }
    return scene;
  }
};

TEST_P(ThrownBall, NeitherPassesThroughNorSinksIn) {
  World world(scene_at(100), {});
  Judge judge(world);
  if (GetParam().asleep) {
    run(world, 5);
    ASSERT_TRUE(world.body(1).asleep);
  }
  for (int i = 0; i < 15; ++i) {
    world.step();
    const collide::SurfaceFigures now = judge.look();
    ASSERT_EQ(now.penetrating_vertices, 0u) << frame_of(world) << ", deepest " << now.deepest;
    ASSERT_EQ(now.overlapping_pairs, 0u) << frame_of(world);
    ASSERT_TRUE(measure(world).finite);
    ASSERT_LT(measure(world).max_speed, 300) << frame_of(world);
  }
  const Motion ball = motion(world, 0), other = motion(world, 1);
  if (!GetParam().sheet || GetParam().held) {  // a free sheet wraps itself around it
    EXPECT_GT(ball.centre.y, other.centre.y) << "it is still above";
  }
  EXPECT_GT(ball.velocity.y, -60) << "it was stopped";
  EXPECT_FALSE(world.body(1).asleep);
  if (!GetParam().held && !GetParam().asleep) {
    EXPECT_NEAR(ball.velocity.y + other.velocity.y, -100, 1e-3);
  }
}

INSTANTIATE_TEST_SUITE_P(At, ThrownBall,
                         testing::Values(Target{"ball", false, false, false}, Target{"held_ball", false, true, false},
                                         Target{"sleeping_ball", false, false, true},
                                         Target{"sheet", true, false, false}, Target{"held_sheet", true, true, false}),
                         [](const auto& target) { return std::string(target.param.name); });

TEST(SurfaceContact, BodiesThatStartInEachOtherComeApartGently) {
  Scene scene = ball_in_space(rubber(0));
  add_body(scene, {0.8, 0.05, 0.02}, glm::dvec3(0.0));  // 0.4 R deep
  World world(scene, {});
  Judge judge(world);
  EXPECT_GT(judge.look().deepest, 0.18);
  const double energy = measure(world).energy;
  for (int i = 0; i < 30; ++i) {
    world.step();
    ASSERT_LT(measure(world).max_speed, 2 * double(SurfaceContact::push_speed)) << frame_of(world);
  }
  judge.expect_clean("after half a second");
  EXPECT_LT(glm::length(motion(world, 0).velocity - motion(world, 1).velocity), 2 * double(SurfaceContact::push_speed));
  EXPECT_LT(measure(world).energy - energy, 0.5 * 2 * 1.0) << "no more than both at the push's speed have";
}

/// A small sheet on a large one that is held; gravity at an angle is a slope.
Scene sheet_on_sheet(double friction, double tangent) {
  const double g = 9.81, angle = std::atan(tangent);
  Material cloth = spring_ball();
  cloth.friction = friction;
  cloth.thickness = 0.01;
  Scene scene = ball_in_space(cloth);
  scene.collision.self_collision = false;
  scene.gravity = g * glm::dvec3(std::sin(angle), -std::cos(angle), 0);
  scene.bodies[0].mesh = {.kind = "grid", .columns = 6, .rows = 6, .width = 6, .depth = 3};
  scene.bodies[0].release = 1000;
  add_body(scene, {-1.03, 0.0101, 0.06}, glm::dvec3(0.0));
  scene.bodies[1].mesh = {.kind = "grid", .columns = 3, .rows = 3, .width = 1, .depth = 1};
  return scene;
}

TEST(SurfaceContact, ASheetOnASlopingSheetSlidesOnlyAboveTheFrictionCone) {
  const double mu = 0.5, g = 9.81;
  for (const double tangent : {0.3, 0.45, 0.55}) {
    World world(sheet_on_sheet(mu, tangent), {});
    run(world, 30);
    const double cosine = 1 / std::sqrt(1 + tangent * tangent), pull = g * cosine * std::max(0.0, tangent - mu);
    EXPECT_NEAR(motion(world, 1).velocity.x, pull * 0.5, 1e-4) << tangent;
    EXPECT_NEAR(motion(world, 1).centre.y, 0.01, 1e-4) << tangent;
  }
}

/// What the scene files call rubber.
Material damped_rubber() {
  Material m = rubber();
  m.internal_damping = 10;
  m.rebound_speed = 2;
  m.rolling_resistance = 0.3;
  return m;
}

TEST(SurfaceContact, AStackInAWellStandsWithoutSinkingIn) {
  Scene scene = ball_in_space(damped_rubber());
  scene.gravity = {0, -9.81, 0};
  scene.ground = Ground{0, 0.6};
  scene.bodies[0].position = {0.02, 0.6, 0.01};
  add_body(scene, {-0.03, 1.7, 0.02}, glm::dvec3(0.0));
  add_body(scene, {0.02, 2.8, -0.03}, glm::dvec3(0.0));
  for (const glm::dvec3& inwards :
       {glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1)})
    scene.planes.push_back({-0.55 * inwards, inwards, 0.3, 0});
  World world(scene, {});
  Judge judge(world);
  for (int i = 0; i < 300; ++i) {
    world.step();
    if (i % 10 == 0) judge.expect_clean(frame_of(world));
  }
  EXPECT_GT(motion(world, 2).centre.y, motion(world, 1).centre.y + 0.7);
  EXPECT_GT(motion(world, 1).centre.y, motion(world, 0).centre.y + 0.7);
}

TEST(SurfaceContact, ClothOverASolidSphereNeverPiercesItself) {
  Scene scene = load_scene(std::filesystem::path(SBCOLLIDE_SCENES) / "cloth.toml");
  scene.contact_surface = ContactSurface::surfaces;
  MeshSource& mesh = scene.bodies[0].mesh;
  mesh.columns = mesh.rows = 24, mesh.width = mesh.depth = 3.6;
  World world(scene, {});
  Judge judge(world);
  for (int i = 0; i < 200; ++i) {
    world.step();
    if (i % 10 == 0) judge.expect_clean(frame_of(world));
  }
  EXPECT_LT(motion(world, 0).centre.y, 1.5) << "it fell and folded";
}

TEST(SurfaceContact, AStarThatFallsOnAStarStaysOutside) {
  Scene scene = load_scene(std::filesystem::path(SBCOLLIDE_SCENES) / "star.toml");
  scene.contact_surface = ContactSurface::surfaces;
  scene.spheres.clear();
  const BodySource star = scene.bodies[0];
  scene.bodies = {star, star};
  scene.bodies[0].position = {0, 0.7, 0};
  scene.bodies[1].position = {0.15, 1.9, 0.1};
  World world(scene, {});
  Judge judge(world);
  judge.expect_clean("at the start");
  bool met = false;
  for (int i = 0; i < 90; ++i) {
    world.step();
    met = met || !world.dynamics().surface_contact().touching().empty();
    if (i % 3 == 0) judge.expect_clean(frame_of(world));
  }
  EXPECT_TRUE(met);
}

/// Four balls that meet in mid-air, enough that a second thread takes part.
Scene crowd() {
  Scene scene = ball_in_space(rubber(), {4, 0, 0});
  scene.gravity = {0, -9.81, 0};
  scene.ground = Ground{-0.8, 0.5};
  add_body(scene, {1.2, 0.3, 0}, {-4, 0, 0});
  add_body(scene, {0.5, 1.2, 0.2}, {0, -4, 0});
  add_body(scene, {0.6, 2.3, 0.1}, {0, -8, 0});
  return scene;
}

/// Balls of several sizes that meet: so many prototypes that a second thread takes part.
Scene sizes() {
  Scene scene = crowd();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) scene.bodies[i].mesh.radius -= 0.02 * double(i);
  return scene;
}

/// Sheets that fall flat on each other: so many rows that threads share the solver too.
Scene sheets() {
  Scene scene = ball_in_space(rubber());
  scene.collision.self_collision = false;
  scene.gravity = {0, -9.81, 0};
  scene.ground = Ground{};
  scene.bodies.clear();
  for (int i = 0; i < 5; ++i) {
    add_body(scene, {0.03 * i, 0.01 + 0.008 * i, 0.02 * i}, glm::dvec3(0.0));
    scene.bodies.back().mesh = {.kind = "grid", .columns = 16, .rows = 16, .width = 2 - 0.1 * i, .depth = 2};
  }
  return scene;
}

TEST(SurfaceContact, IsTheSameOnAnyThreadsAndInstructionSet) {
  std::size_t most_rows = 0;
  const auto hash = [&](const Scene& scene, int frames, int threads, Isa isa) {
    World::Options options;
    options.threads = threads;
    options.isa = isa;
    World world(scene, options);
    for (int i = 0; i < frames; ++i) {
      world.step();
      most_rows = std::max(most_rows, world.dynamics().surface_contact().rows());
    }
    return world.state_hash();
  };
  for (const auto& [scene, frames] : {std::pair(sizes(), 25), std::pair(sheets(), 10)}) {
    const std::uint64_t expected = hash(scene, frames, 1, Isa::baseline);
    for (const Isa isa : isas())
      for (const int threads : {1, 2}) EXPECT_EQ(hash(scene, frames, threads, isa), expected) << threads;
  }
  EXPECT_GT(most_rows, 2000u);
}

TEST(SurfaceContact, MayBeTurnedOnAndOffAtAnyTime) {
  World world(crowd(), {});
  Judge judge(world);
  for (int i = 0; i < 60; ++i) {
    if (i % 7 == 3) world.set_contact_surface(ContactSurface::vertices);
    if (i % 7 == 5) world.set_contact_surface(ContactSurface::surfaces);
    world.step();
    ASSERT_TRUE(measure(world).finite) << frame_of(world);
    ASSERT_LT(measure(world).max_speed, 40) << frame_of(world);
  }
  world.set_contact_surface(ContactSurface::surfaces);
  EXPECT_TRUE(world.plan().has(Stage::surface_contact));
  EXPECT_FALSE(world.plan().has(Stage::contact_response));
  run(world, 60);
  judge.expect_clean("after a second of surface contact");
}

TEST(SurfaceContact, LeavesVertexContactAsItIs) {
  const auto hash = [](double restitution, bool to_and_fro) {
    Scene scene = crowd();
    scene.contact_surface = ContactSurface::vertices;
    scene.materials[0].restitution = restitution;
    World world(scene, {});
    if (to_and_fro) {
      world.set_contact_surface(ContactSurface::surfaces);
      world.set_contact_surface(ContactSurface::vertices);
    }
    run(world, 30);
    return world.state_hash();
  };
  EXPECT_EQ(hash(0.9, false), hash(0, false)) << "restitution is of surface contact";
  EXPECT_EQ(hash(0, true), hash(0, false));
}

}  // namespace
}  // namespace softbody::test
