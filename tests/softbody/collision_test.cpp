// What the response to contacts does to bodies: momenta, energy, and that none passes through another.

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "softbody/forces/penalty_law.h"
#include "tests/softbody/helpers.h"
#include "tests/support/world_test_access.h"

namespace softbody::test {
namespace THIS_FILE {

/// Two bodies meet off the line of their centres, one three times as heavy. After 90 frames they are apart.
Scene unlike_bodies_that_meet() {
  Scene scene = lone_body(gas_ball(), glm::dvec3(3, 0.2, 0));
  scene.materials[0][Material::internal_damping] = 5;
  scene.materials.push_back(scene.materials[0]);
  scene.materials[1][Material::mass] = 3;
  add_body(scene, {1.6, 0.3, 0.1}, {-1.5, 0, 0.3});
  scene.bodies[1].material = 1;
  return scene;
}

TEST(Collision, ConservesMomentum) {
  World world(unlike_bodies_that_meet(), {});
  const Measures before = measure(world);
  const double size = 3 * 1 + 1.5 * 3;
  std::size_t contacts = 0;
  for (int i = 0; i < 90; ++i) {
    world.step();
    contacts += world.detection().contacts.size();
    ASSERT_LT(glm::distance(measure(world).momentum, before.momentum), 1e-5 * size) << "frame " << i;
  }
  EXPECT_GT(contacts, 20u);
}

TEST(Collision, LosesEnergy) {
  World world(unlike_bodies_that_meet(), {});
  const double before = measure(world).energy;
  run(world, 90);
  EXPECT_TRUE(world.detection().contacts.empty());
  EXPECT_LT(measure(world).energy, before);
  const double apart = motion(world, 1).velocity.x - motion(world, 0).velocity.x;
  EXPECT_GT(apart, 0);
  EXPECT_LT(apart, PenaltyLaw<double>::rebound_speed + 1) << "no faster than penalty contact allows";
}

TEST(Collision, FrictionSpringsSlipOnceAStepInEveryExplicitIntegrator) {
  const auto stretch = [](const char* integrator) {
    Scene scene = lone_body(spring_ball());
    scene.materials[0][contact::friction] = 10;
    add_body(scene, {0, 1.03, 0}, {0.1, 0, 0});
    World world(scene, {.frame_time = 1e-4, .integrator = {integrator, 1}});
    run(world, 10);
    double sum = 0;
    const PenaltyPairs& pairs = WorldTestAccess::solver(world).penalty_contact().pairs();
    for (std::size_t i = 0; i < pairs.size(); ++i) sum += double(glm::length(pair_of(pairs, i).stretch));
    EXPECT_GT(sum, 5e-5) << integrator;
    return sum;
  };
  const double expected = stretch("semi-implicit-euler");
  for (const char* integrator : {"velocity-verlet", "rk4"})
    EXPECT_NEAR(stretch(integrator), expected, 0.15 * expected) << integrator;
}

/// The softer of two bodies tells how stiff their contacts are; who has several at a particle shares it among them.
TEST(Collision, PairsOfUnlikeBodiesHaveTheSofterContactAndTheMeanFriction) {
  for (const bool softer_first : {false, true}) {
    Scene scene = lone_body(gas_ball());
    scene.materials.push_back(scene.materials[0]);
    Material &soft = scene.materials[softer_first ? 0 : 1], &hard = scene.materials[softer_first ? 1 : 0];
    soft[contact::stiffness] = 40, hard[contact::stiffness] = 90;
    soft[contact::friction] = 0.2, hard[contact::friction] = 0.8;
    add_body(scene, {0, 0.8, 0.1}, glm::dvec3(0.0));
    scene.bodies[1].material = 1;
    scene.bodies[1].mesh = {.subdivisions = 3, .radius = 0.35};
    scene.bodies[0].release = 1000;
    scene.bodies.push_back(scene.bodies[0]);  // two that are held have no contact
    scene.bodies[2].position = {0.6, 0.75, 0};
    World world(scene, {});
    std::vector<collide::Contact> contacts = world.detection().contacts;
    const auto both_held = [&](const collide::Contact& c) {
      return world.bodies().body_of(c.a) != 1 && world.bodies().body_of(c.b) != 1;
    };
    EXPECT_GT(std::erase_if(contacts, both_held), 0u);
    world.step();
    const PenaltyPairs& pairs = WorldTestAccess::solver(world).penalty_contact().pairs();
    ASSERT_EQ(pairs.size(), contacts.size());
    std::vector<int> count(world.bodies().vertex_count(), 0);
    for (const collide::Contact& c : contacts) ++count[c.a], ++count[c.b];
    const float softer =
        float(std::min(world.model(0).material[contact::stiffness], world.model(1).material[contact::stiffness]));
    int more_at_a = 0, more_at_b = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const PenaltyPair pair = pair_of(pairs, i);
      const int a = count[pair.contact.a], b = count[pair.contact.b];
      more_at_a += a > b, more_at_b += b > a;
      EXPECT_FLOAT_EQ(pair.stiffness, softer / float(std::max(a, b)));
      EXPECT_FLOAT_EQ(pair.friction, 0.4f);
    }
    EXPECT_GT(more_at_a, 0);
    EXPECT_GT(more_at_b, 0);
  }
}

/// Returns the mean normal of the faces at a vertex, weighted by their areas.
glm::dvec3 vertex_normal(const World& world, Index vertex) {
  const BodyId body = world.bodies().body_of(vertex);
  const std::vector<Particle> x = particles_of(world, body);
  const Index own = vertex - world.bodies().first[body];
  glm::dvec3 sum(0.0);
  for (const auto& [a, b, c] : world.model(body).mesh.triangles)
    if (a == own || b == own || c == own)
      sum += glm::cross(x[b].position - x[a].position, x[c].position - x[a].position);
  return glm::normalize(sum);
}

/// The bodies are apart, one is inside the other, or a sheet lies on a ball.
TEST(Collision, ActsAlongTheSurfacesNormalsWhereClosedBodiesFaceEachOther) {
  int by_surfaces = 0, by_line = 0;
  for (const bool sheet : {false, true})
    for (const double height : {sheet ? 0.52 : 0.8, 0.1}) {
      Scene scene = lone_body(gas_ball());
      add_body(scene, {0.02, height, 0.05}, glm::dvec3(0.0));
      scene.bodies[1].mesh = {.subdivisions = 3, .radius = 0.35};
      if (sheet) scene.bodies[1].mesh = {.kind = "grid", .columns = 7, .rows = 5, .width = 1, .depth = 0.8};
      World world(scene, {});
      const auto place = [&](Index v) {
        const BodyId body = world.bodies().body_of(v);
        return particles_of(world, body)[v - world.bodies().first[body]].position;
      };
      std::vector<glm::dvec3> expected;
      for (const auto& [a, b] : world.detection().contacts) {
        const glm::dvec3 apart = vertex_normal(world, b) - vertex_normal(world, a);
        const bool facing = !sheet && glm::length(apart) > 0.5;
        expected.push_back(glm::normalize(facing ? apart : place(a) - place(b)));
        ++(facing ? by_surfaces : by_line);
      }
      world.step();
      const PenaltyPairs& pairs = WorldTestAccess::solver(world).penalty_contact().pairs();
      ASSERT_EQ(pairs.size(), expected.size());
      for (std::size_t i = 0; i < pairs.size(); ++i)
        EXPECT_LT(glm::distance(glm::dvec3(pair_of(pairs, i).normal), expected[i]), 1e-3) << i;
    }
  EXPECT_GT(by_surfaces, 10);
  EXPECT_GT(by_line, 10);
}

TEST(Collision, BodiesDoNotPassThroughEachOther) {
  for (const double speed : {1.0, 6.0}) {
    Scene scene = lone_body(gas_ball(), glm::dvec3(speed, 0, 0));
    add_body(scene, {1.5, 0.02, 0.03}, {-speed, 0, 0});
    World world(scene, {});
    double nearest = 10;
    for (int i = 0; i < 90; ++i) {
      world.step();
      nearest = std::min(nearest, motion(world, 1).centre.x - motion(world, 0).centre.x);
    }
    EXPECT_GT(nearest, 0.3) << speed << " m/s";
    EXPECT_GT(motion(world, 1).velocity.x - motion(world, 0).velocity.x, 0) << "they bounce";
  }
}

/// Flat enough for its two sides to meet, and pressed together further while it flies and turns.
TEST(Collision, InsideOneBodyConservesMomentumAndSpin) {
  const auto fly = [](bool with_itself) {
    Scene scene = lone_body(spring_ball());
    scene.materials[0][contact::friction] = 0;  // a couple over the distance that it is kept at, which would take spin
    scene.collision.self_collision = with_itself;
    scene.collision.tolerance = 0.1f;
    World world(scene, {.frame_time = 1.0 / 240});
    std::vector<Particle> flat;
    for (const glm::dvec3& x : world.model(0).start) {
      const glm::dvec3 place(x.x, 0.1 * x.y, x.z);
      flat.push_back(
          {place, glm::dvec3(1, 2, 3) + glm::cross(glm::dvec3(0.5, 2, -0.5), place) - glm::dvec3(0, x.y, 0)});
    }
    world.set_particles(0, flat);
    const Motion before = motion(world, 0);
    const double spin = glm::length(before.spin_momentum);
    EXPECT_GT(spin, 0.1);
    std::uint64_t self = 0;
    for (int i = 0; i < 60; ++i) {
      self += world.detection().self_contacts;
      world.step();
      const Motion after = motion(world, 0);
      EXPECT_LT(glm::distance(after.velocity, before.velocity), 1e-5) << "frame " << i;
      // The normals stand for a frame, in which what they push apart turns.
      EXPECT_LT(glm::distance(after.spin_momentum, before.spin_momentum), 5e-3 * spin) << "frame " << i;
    }
    if (with_itself) {
      EXPECT_GT(self, 200u);
    }
    return particles_of(world);
  };
  const auto kept_apart = fly(true), through_itself = fly(false);
  double most = 0;
  for (std::size_t i = 0; i < kept_apart.size(); ++i)
    most = std::max(most, glm::distance(kept_apart[i].position, through_itself[i].position));
  EXPECT_GT(most, 0.01) << "its contacts act";
}

}  // namespace THIS_FILE
}  // namespace softbody::test
