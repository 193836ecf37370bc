// The world: arrivals, the dropper, settings, what can be read.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/softbody/helpers.h"
#include "tests/support/change.h"

namespace softbody::test {
namespace THIS_FILE {

TEST(World, AddsAndReleasesBodiesAtTheirFrames) {
  Scene scene = lone_body(spring_ball());
  scene.gravity = {0, -9.81, 0};
  add_body(scene, {3, 5, 0}, {1, 0, 0});
  scene.bodies[1].appear = 4;
  scene.bodies[1].release = 7;
  World world(scene, {});
  for (int frame = 1; frame <= 9; ++frame) {
    world.step();
    EXPECT_EQ(world.bodies().count(), frame > 4 ? 2u : 1u) << "frame " << frame;
    if (frame <= 4) continue;
    const double flown = std::max(0, frame - 7) / 60.0;
    EXPECT_NEAR(motion(world, 1).centre.x, 3 + flown, 1e-5) << "frame " << frame;
    EXPECT_EQ(world.body(1).pinned, frame <= 7);
  }
  EXPECT_EQ(world.frame(), 9);
}

TEST(World, ShowsThePositionsAfterEachSubstep) {
  World world(lone_body(spring_ball(), {3, -6, 12}), {.threads = 2, .integrator = {.substeps = 4}, .least_share = 0});
  const glm::dvec3 start = motion(world, 0).centre;
  int substeps = 0;
  world.step([&] {
    const collide::Frame now = world.positions();
    glm::dvec3 centre(0.0);
    for (Index i = 0; i < 162; ++i) centre += glm::dvec3(now.x[i], now.y[i], now.z[i]) / 162.0;
    const glm::dvec3 moved = centre - start, expected = glm::dvec3(3, -6, 12) * (++substeps / 4.0 / 60);
    EXPECT_LT(glm::length(moved - expected), 1e-5) << "substep " << substeps;
  });
  EXPECT_EQ(substeps, 4);
}

TEST(World, FollowsNewSettingsAtOnce) {
  World world(drop_scene(), {});
  do world.step();
  while (world.detection().contacts.size() < 20 && world.frame() < 800);
  EXPECT_FALSE(world.scene().collision.cell_size);
  const glm::vec3 usual = *world.collision().cell_size;
  const std::size_t before = world.detection().contacts.size();
  change(world, [&](Scene& s) { s.collision.tolerance = 0.2f, s.collision.levels = 6; });
  EXPECT_GT(world.detection().contacts.size(), before);
  EXPECT_LT(world.collision().cell_size->x, usual.x) << "the default follows the levels";
  change(world, [&](Scene& s) { s.collision.cell_size = glm::vec3(0.3f); });
  EXPECT_TRUE(world.scene().collision.cell_size);
  EXPECT_EQ(world.collision().cell_size, glm::vec3(0.3f));
  change(world, [&](Scene& s) { s.method = "grid-hash"; });
  EXPECT_EQ(world.method().key, "grid-hash");
}

TEST(World, HashesDifferentStatesDifferently) {
  const auto hash_of = [](double x, double v) {
    Scene scene = lone_body(spring_ball(), {v, 0, 0});
    scene.bodies[0].position.x = x;
    return World(scene, {}).state_hash();
  };
  EXPECT_EQ(hash_of(1, 2), hash_of(1, 2));
  EXPECT_NE(hash_of(1, 2), hash_of(1, std::nextafter(2.0f, 3.0f)));
  EXPECT_NE(hash_of(1, 2), hash_of(std::nextafter(1.0, 2.0), 2));
}

TEST(Dropper, PutsBodiesClearOfAllOthers) {
  World world(drop_scene(), {});
  for (int i = 0; i < 20; ++i) {
    const BodyId id = world.drop();
    EXPECT_EQ(id, world.bodies().count() - 1);
    const auto& contacts = world.detection().contacts;
    EXPECT_TRUE(std::none_of(
        contacts.begin(), contacts.end(),
        [&](const collide::Contact& c) { return world.bodies().body_of(c.a) != world.bodies().body_of(c.b); }))
        << "drop " << i;
    const glm::dvec3 at = motion(world, id).centre;
    EXPECT_LE(std::hypot(at.x, at.z), world.scene().dropper->spread + 1e-3);
    EXPECT_GE(at.y, world.scene().dropper->body.position.y - 1e-3);
  }
  run(world, 300);
  EXPECT_TRUE(measure(world).finite);
  EXPECT_LT(measure(world).deepest_penetration, 1e-5);
}

TEST(World, PutsParticlesWhereItIsTold) {
  Scene scene = lone_body(spring_ball());
  add_body(scene, {5, 0, 0}, glm::dvec3(0.0));
  World world(scene, {});
  std::vector<Particle> told;
  for (Index i = 0; i < world.model(1).mesh.vertices.size(); ++i) {
    Particle p = world.particle(1, i);
    told.push_back({glm::dvec3(1000, 0, -2000) + 10.0 * p.position, {0.5, 0, double(i)}});
  }
  const Particle other = world.particle(0, 7);
  world.set_particles(1, told);
  for (Index i = 0; i < told.size(); ++i) {
    const Particle p = world.particle(1, i);
    EXPECT_LT(glm::distance(p.position, told[i].position), 1e-6) << "far from zero, too: the origin has gone along";
    EXPECT_EQ(p.velocity, told[i].velocity);
  }
  EXPECT_EQ(world.particle(0, 7).position, other.position);
  EXPECT_NEAR(world.positions().x[world.bodies().first[1]], told[0].position.x, 1e-4) << "detectors see them there";
}

}  // namespace THIS_FILE
}  // namespace softbody::test
