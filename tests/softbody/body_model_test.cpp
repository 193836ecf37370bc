// What make_body_model() derives from a mesh and a material.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <utility>

#include "softbody/mechanics/bound.h"
#include "softbody/mechanics/make_body_model.h"
#include "softbody/world/body_model_set.h"
#include "tests/softbody/helpers.h"
#include "tests/softbody/obj_lines.h"

namespace softbody::test {
namespace THIS_FILE {

TEST(BodyModel, IsSharedByAllThatAreMadeOfTheSameWhileOneLives) {
  Material m = spring_ball(), renamed = m, stiffer = m;
  renamed.name += " again";
  stiffer[StructuralSprings::stiffness] *= 2;
  auto one = shared_body_model({}, m);
  EXPECT_EQ(shared_body_model({}, m), one);
  EXPECT_NE(shared_body_model({}, renamed), one) << "worlds tell body models of different materials apart by this";
  EXPECT_EQ(shared_body_model({}, renamed)->material.name, renamed.name);
  EXPECT_NE(shared_body_model({}, stiffer), one);
  EXPECT_NE(shared_body_model({.subdivisions = 1}, m), one);
  const std::weak_ptr<const BodyModel> before = std::exchange(one, nullptr);
  EXPECT_TRUE(before.expired()) << "nothing is kept for its own sake";
  EXPECT_EQ(springs<StructuralSprings>(*shared_body_model({}, m)).size(), 480u);
}

TEST(BodyModel, HasOneSpringAPairWithTheMeshsOwnLengthsAndTheMaterialsValues) {
  Material m = spring_ball();
  m[Material::mass] = 3;
  m.set(StructuralSprings::keys, {300, 0.2});
  m.set(BendSprings::keys, {75, 0.4});
  m.set(ShearSprings::keys, {10, 0.1});
  const auto ball = make_body_model({}, m);
  const double reduced = 3.0 / 162 / 2;  // kg, of two particles
  EXPECT_DOUBLE_EQ(ball->particle_mass, 3.0 / 162);
  const auto expect_springs = [&](const std::vector<Spring>& all, double stiffness, double damping_ratio) {
    EXPECT_EQ(all.size(), 480u);
    for (const Spring& s : all) {
      EXPECT_DOUBLE_EQ(s.rest, glm::distance(ball->mesh.vertices[s.i], ball->mesh.vertices[s.j]));
      EXPECT_EQ(s.stiffness, stiffness);
      EXPECT_NEAR(s.damping, damping_ratio * 2 * std::sqrt(stiffness * reduced), 1e-12);
    }
  };
  expect_springs(springs<StructuralSprings>(*ball), 300, 0.2);
  expect_springs(springs<BendSprings>(*ball), 75, 0.4);
  EXPECT_TRUE(springs<ShearSprings>(*ball).empty()) << "shear springs are for quads";
  EXPECT_EQ(springs<ShearSprings>(*make_body_model({.kind = "grid", .columns = 3, .rows = 3}, m)).size(), 18u);
  m[BendSprings::stiffness] = 0;
  EXPECT_TRUE(springs<BendSprings>(*make_body_model({}, m)).empty());
}

/// The spokes of a fan share what six springs have in a regular net.
TEST(BodyModel, SpringsHaveTheirSharesOfStiffnessAndDamping) {
  constexpr int spokes = 18;
  std::string fan = vertex({0, 1, 0});
  for (int i = 0; i < spokes; ++i)
    fan += vertex({std::cos(2 * std::numbers::pi * i / spokes), 0, std::sin(2 * std::numbers::pi * i / spokes)});
  for (int i = 0; i < spokes; ++i) fan += face({1, 2 + i, 2 + (i + 1) % spokes});
  const TemporaryFolder folder;
  Material m = spring_ball();
  m[Material::mass] = 2;
  m.set(StructuralSprings::keys, {300, 0.2});
  const auto p = make_body_model(MeshSource::from_file({.path = folder.write("fan.obj", fan)}), m);
  const auto& found = springs<StructuralSprings>(*p);
  ASSERT_EQ(found.size(), p->mesh.edge_shares.size());
  double at_hub = 0;
  for (std::size_t s = 0; s < found.size(); ++s) {
    const double share = p->mesh.edge_shares[s];
    EXPECT_DOUBLE_EQ(found[s].stiffness, share * 300);
    EXPECT_NEAR(found[s].damping, share * 0.2 * 2 * std::sqrt(300 * 2.0 / 162 / 2), 1e-12);
    if (found[s].i == 0) at_hub += found[s].stiffness;
  }
  EXPECT_LT(at_hub, 6 * 300);
  EXPECT_EQ(p->largest_degree, spokes);
}

TEST(PairBound, HasTheEigenvaluesOfKnownGraphs) {
  const auto bound = [](std::size_t particles, const std::vector<Edge>& edges) {
    std::vector<WeightedPair> pairs;
    for (const auto& [i, j] : edges) pairs.push_back({i, j, 3});
    return pair_bound(particles, pairs) / 3;
  };
  EXPECT_NEAR(bound(2, {{0, 1}}), 2, 1e-9) << "as Gershgorin has it";
  EXPECT_NEAR(bound(4, {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}), 4 * 1.01, 1e-9) << "complete: their number";
  std::vector<Edge> star, ring;
  for (Index i = 1; i < 60; ++i) star.push_back({0, i});
  for (Index i = 0; i < 60; ++i) ring.push_back({i, (i + 1) % 60});
  EXPECT_NEAR(bound(60, star), 60 * 1.01, 1e-6) << "the hub's sum and one";
  EXPECT_NEAR(bound(60, ring), 4, 1e-6) << "an even ring swings against itself, as Gershgorin has it";
  EXPECT_EQ(bound(3, {}), 0);
}

/// Power iteration finds the eigenvalue from below; the bound may be a little above it.
TEST(PairBound, HoldsTheNetsOfBodiesClosely) {
  Material m = spring_ball();
  m.set(StructuralSprings::keys, {300, 0.2});
  m.set(BendSprings::keys, {75, 0.4});
  m.set(ShearSprings::keys, {100, 0.1});
  MeshSource grid, ball;
  grid.kind = "grid";
  for (const MeshSource& source : {grid, ball})
    for (const auto property : {&Spring::stiffness, &Spring::damping}) {
      const auto p = make_body_model(source, m);
      std::vector<WeightedPair> pairs;
      for_each_spring(*p, [&](const Spring& s) { pairs.push_back({s.i, s.j, s.*property}); });
      const std::size_t count = p->mesh.vertices.size();
      std::vector<double> v(count);
      for (std::size_t i = 0; i < count; ++i) v[i] = std::sin(double(i * i));
      double length = 0;
      for (int step = 0; step < 2000; ++step) {
        std::vector<double> next(count, 0.0);
        for (const auto& [i, j, weight] : pairs) {
          const double pull = weight * (v[i] - v[j]);
          next[i] += pull, next[j] -= pull;
        }
        length = std::sqrt(std::inner_product(next.begin(), next.end(), next.begin(), 0.0));
        for (std::size_t i = 0; i < count; ++i) v[i] = next[i] / length;
      }
      const double bound = pair_bound(count, pairs);
      EXPECT_GE(bound, length * (1 - 1e-9)) << source.kind;
      EXPECT_LE(bound, length * 1.05) << source.kind;
      EXPECT_EQ(bound / 2, property == &Spring::stiffness ? p->forces->pair_stiffness : p->forces->pair_damping);
    }
}

TEST(BodyModel, GasIsForClosedMeshesWithSomePressure) {
  MeshSource grid;
  grid.kind = "grid";
  EXPECT_FALSE(data<GasPressure>(*make_body_model({}, spring_ball())));
  EXPECT_FALSE(data<GasPressure>(*make_body_model(grid, gas_ball())));
  EXPECT_EQ(make_body_model(grid, gas_ball())->start_volume, 0);
  const auto p = make_body_model({}, gas_ball());
  const Gas* gas = data<GasPressure>(*p);
  ASSERT_TRUE(gas);
  EXPECT_DOUBLE_EQ(gas->rest_volume, volume(p->mesh.vertices, p->mesh.triangles));
  EXPECT_DOUBLE_EQ(gas->pressure(gas->rest_volume), 113000);
  EXPECT_EQ(gas->ambient, 101325);
}

TEST(BodyModel, DetectorsSeeItsEdgesAndRestDistances) {
  const auto p = make_body_model({}, spring_ball());
  EXPECT_EQ(p->shape->vertex_count(), 162u);
  const auto& [i, j] = p->mesh.edges.front();
  EXPECT_TRUE(p->shape->excludes(i, j, 1e-12f));
  Index far = 1;
  while (glm::distance(p->mesh.vertices[0], p->mesh.vertices[far]) < 0.9) ++far;
  EXPECT_FALSE(p->shape->excludes(0, far, 0.25f));
  EXPECT_TRUE(p->shape->excludes(0, far, 1.5f)) << "closer than the tolerance at rest";
}

TEST(BodyModelSet, SharesOneAPairOfMeshAndMaterial) {
  Scene scene = lone_body(spring_ball());
  scene.materials.push_back(gas_ball());
  add_body(scene, glm::dvec3(3, 0, 0), glm::dvec3(0.0));
  add_body(scene, glm::dvec3(6, 0, 0), glm::dvec3(0.0));
  add_body(scene, glm::dvec3(9, 0, 0), glm::dvec3(0.0));
  scene.bodies[2].material = 1;
  scene.bodies[3].mesh.subdivisions = 1;
  const BodyModelSet set(scene);
  EXPECT_EQ(set.all().size(), 3u);
  EXPECT_EQ(set.of(scene.bodies[0]), set.of(scene.bodies[1]));
  EXPECT_NE(set.of(scene.bodies[0]), set.of(scene.bodies[2]));
  EXPECT_EQ(set.of(scene.bodies[3])->mesh.vertices.size(), 42u);
}

TEST(BodyModel, IsAsThickAsItsSizeAsksFor) {
  const auto thickness = [](double radius, const Material& material) {
    return make_body_model({.radius = radius}, material)->material[Material::thickness];
  };
  EXPECT_EQ(thickness(0.5, {}), 0.005) << "the paper's sphere";
  EXPECT_NEAR(thickness(0.001, {}), 1e-5, 1e-12);
  Material given;
  given[Material::thickness] = 0.02;
  EXPECT_EQ(thickness(0.001, given), 0.02);
}

/// A cap of the height h that is cut off a ball of radius 1 leaves a hole of h / 2 of the rest's area, seen from above.
TEST(BodyModel, RollsIfItIsNearlyClosed) {
  const auto rolls = [](double height) {
    Mesh mesh = icosphere(3, 1);
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
      return mesh.vertices[t[0]].y + mesh.vertices[t[1]].y + mesh.vertices[t[2]].y > 3 * (1 - height);
    });
    connect_triangles(mesh);
    return make_body_mesh(std::move(mesh))->rolls;
  };
  EXPECT_TRUE(rolls(0));
  EXPECT_TRUE(rolls(0.12));
  EXPECT_FALSE(rolls(0.3));
  EXPECT_FALSE(make_body_model({.kind = "grid", .columns = 3, .rows = 3, .width = 1, .depth = 1}, {})->rolls);
}

}  // namespace THIS_FILE
}  // namespace softbody::test
