// Implicit steps: their matrix, stiffness without end, rest on a solid, exact equilibria, and what auto makes of them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "softbody/integrate/implicit/matrix.h"
#include "softbody/integrate/implicit/quasi_newton.h"
#include "softbody/mechanics/make_body_model.h"
#include "tests/softbody/helpers.h"
#include "tests/support/world_test_access.h"

namespace softbody::test {
namespace THIS_FILE {

/// Its mean height when at rest is worked out by nobody: explicit steps of the same model say it.
Scene ball_above_ground(double stiffness, double height) {
  Material m = gas_ball();
  m.set(StructuralSprings::keys, {stiffness, 0.1});
  m.set(BendSprings::keys, {stiffness / 4, 0.1});
  Scene scene = lone_body(damped(m));
  scene.gravity = {0, -9.81, 0};
  scene.bodies[0].position = {0, height, 0};
  set_solid(scene, {Ground{}});
  return scene;
}

/// In lane 0: x = A^-1 x, the gas by Sherman and Morrison.
void solve(const ImplicitMatrix& a, Lanes& x) {
  Lanes room(x.size());
  implicit_kernels().substitute(a.factor(), x.data(), room.data());
  double along = 0;
  for (std::size_t i = 0; i < a.gas().size(); ++i) along += a.gas()[i] * x[i * implicit_lanes];
  for (std::size_t i = 0; i < a.gas().size(); ++i)
    x[i * implicit_lanes] -= a.gas_weight() * along * a.gas_response()[i];
}

TEST(ImplicitMatrix, ComplianceIsTheInverse) {
  for (const bool closed : {true, false}) {
    MeshSource source;
    source.subdivisions = 1;
    if (!closed) source.kind = "grid", source.columns = source.rows = 6;
    Material m = gas_ball();
    m.set(ShearSprings::keys, {50, 0.1});
    const auto p = make_body_model(source, m);
    const ImplicitMatrix a(*p, 1e-2);
    const auto n = static_cast<Index>(p->mesh.vertices.size());
    ASSERT_EQ(a.rotates(), closed);
    // A unit force on one particle, through the factor and Sherman-Morrison, as a solve has it.
    const Index j = n / 2;
    Lanes x((closed ? 3 : 1) * n * implicit_lanes);
    x[j * implicit_lanes] = 1;
    solve(a, x);
    for (Index i = 0; i < n; ++i) {
      const glm::dmat3 c = a.compliance(i, j), back = a.compliance(j, i);
      EXPECT_NEAR(c[0][0], x[i * implicit_lanes], 1e-12);
      EXPECT_NEAR(c[0][1], back[1][0], 1e-12) << "symmetric";
      if (closed) {
        EXPECT_NEAR(c[0][2], x[(2 * n + i) * implicit_lanes], 1e-12);
      }
    }
    EXPECT_GT(glm::determinant(a.compliance(j, j)), 0);
  }
}

TEST(ImplicitMatrix, IsTheDerivativeOfAllForcesInBalance) {
  constexpr double h = 1e-2, tiny = 1e-6;
  Material m = gas_ball();
  m.set(StructuralSprings::keys, {1e4, 0});
  m.set(BendSprings::keys, {2e3, 0});
  m[Material::start_in_equilibrium] = false;  // it finds the balance itself
  const auto p = make_body_model({}, m);
  const ImplicitMatrix a(*p, h);
  const std::size_t n = p->mesh.vertices.size();
  std::vector<glm::dvec3> ahead = a.shape(), back = ahead, d(n);
  std::mt19937 random(1);
  for (std::size_t i = 0; i < n; ++i) {
    d[i] = random_vector(random, 1);
    ahead[i] += tiny * d[i], back[i] -= tiny * d[i];
  }
  const auto after = forces(*p, ahead), before = forces(*p, back);
  Lanes x(3 * n * implicit_lanes);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      x[(k * n + i) * implicit_lanes] =
          p->particle_mass / (h * h) * d[i][int(k)] - (after[i] - before[i])[int(k)] / (2 * tiny);
  solve(a, x);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(x[(k * n + i) * implicit_lanes], d[i][int(k)], 1e-4);
}

/// With another step length only the shape in balance is taken over.
TEST(ImplicitMatrix, TakesOnlyTheShapeFromOneOfAnotherStepLength) {
  Material m = gas_ball();
  m[Material::start_in_equilibrium] = false;  // so that the shape in balance is not the one of the start
  const auto p = make_body_model({}, m);
  const ImplicitMatrix other(*p, 1e-2), again(*p, 2e-3, &other), fresh(*p, 2e-3);
  EXPECT_GT(glm::distance(fresh.shape()[0], p->start[0]), 1e-3);
  EXPECT_EQ(again.shape(), fresh.shape());
  EXPECT_EQ(again.gas_weight(), fresh.gas_weight());
  EXPECT_EQ(again.contact_stiffness(), fresh.contact_stiffness());
  const std::size_t n = p->mesh.vertices.size();
  std::mt19937 random(2);
  Lanes x(3 * n * implicit_lanes);
  for (std::size_t i = 0; i < 3 * n; ++i) x[i * implicit_lanes] = uniform(random, -1, 1);
  Lanes expected = x, otherwise = x;
  solve(again, x);
  solve(fresh, expected);
  solve(other, otherwise);
  EXPECT_EQ(x, expected);
  EXPECT_NE(x, otherwise);
}

TEST(ImplicitMatrix, CanBeFactoredWithHardlyAnyMass) {
  Material m = gas_ball();
  m.set(StructuralSprings::keys, {1e9, 0.1});
  m[Material::mass] = 1e-12;
  const ImplicitMatrix a(*make_body_model({}, m), 0.5);
  EXPECT_TRUE(std::isfinite(glm::determinant(a.compliance(1, 1))));
}

/// Between planes that leave it no place there are no contact forces to be found.
TEST(QuasiNewton, LimitsItsWorkOnACrushedBody) {
  const auto p = make_body_model({}, gas_ball());
  const double h = 1.0 / 60, r = p->radius;
  const ImplicitMatrix matrix(*p, h);
  QuasiNewton solver(*p);
  const std::size_t n = p->mesh.vertices.size(), max_contacts = 300;
  const Lanes none(3 * n * implicit_lanes);
  ImplicitStart start{none, none, none, none, {1}};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 3; ++k) start.x[(k * n + i) * implicit_lanes] = matrix.shape()[i][int(k)];
  std::vector<PlaneContact> planes;
  for (std::size_t i = 0; i < std::min(n, max_contacts / 2); ++i)
    for (const double side : {1.0, -1.0}) planes.push_back({{{i * implicit_lanes}}, 0.5, 0, {side, 0, 0}, r});
  const Lanes& end = solver.solve({*p, matrix, h, start, h, planes});
  EXPECT_TRUE(std::all_of(end.begin(), end.end(), [](double x) { return std::isfinite(x); }));
  const double iterations = (30 + 8) * 12, sweeps = 2 * 4e6 / 256;
  const double done = solver.take_work(), last_sweeps = 2 * double(max_contacts * max_contacts) / 256;
  EXPECT_GE(done, sweeps) << "they count";
  EXPECT_LE(done, iterations * double(n) + sweeps + last_sweeps);
  EXPECT_EQ(solver.take_work(), 0);
}

TEST(Implicit, StandsAnyStiffnessAtSixtyFramesASecond) {
  for (const double stiffness : {1e2, 1e6, 1e8}) {
    World world(ball_above_ground(stiffness, 0.8), {.integrator = {"implicit", 1}});
    const double start = measure(world).energy;
    for (int frame = 0; frame < 120; ++frame) {
      world.step();
      const Measures m = measure(world);
      ASSERT_TRUE(m.finite) << stiffness << " N/m, frame " << frame;
      ASSERT_LT(m.energy, start + 0.05 * 9.81) << stiffness << " N/m, frame " << frame;
      ASSERT_LT(m.deepest_penetration, 1e-5) << stiffness << " N/m, frame " << frame;
    }
    const Measures end = measure(world);
    EXPECT_LT(end.max_speed, 1e-2) << stiffness;
    EXPECT_NEAR(end.volume_ratio_min, 1, 1e-2) << stiffness;
  }
}

/// J, the most that a world gains over where it starts, the energy of its penalty pairs counted.
double max_gained(World& world, int frames) {
  const auto energy = [&] { return measure(world).energy + WorldTestAccess::penalty_energy(world); };
  const double start = energy();
  double most = 0;
  for (int f = 0; f < frames; ++f) {
    world.step();
    most = std::max(most, energy() - start);
  }
  return most;
}

TEST(Implicit, ContactWithSolidsGivesAStiffBodyNoEnergy) {
  for (const double frame_time : {1.0 / 30, 1.0 / 240}) {
    Scene scene = ball_above_ground(1e7, 0.9);
    add_solid(scene, {SolidSphere{.centre = {0.1, -0.3, 0}, .radius = 0.5}});  // it rolls off this one
    scene.bodies[0].velocity = {0, -20, 0};
    World world(scene, {.frame_time = frame_time, .integrator = {"implicit", 1}});
    EXPECT_LT(max_gained(world, int(0.7 / frame_time)), 0.1) << frame_time;
  }
}

/// What penalty contacts do in a step is not known at its start: particles end behind planes that looked far.
TEST(Implicit, BodiesThatPushEachOtherIntoASolidGainNoEnergy) {
  Scene scene = ball_above_ground(1e7, 1.6);
  add_solid(scene, {SolidSphere{.centre = {0, 0.5, 0}, .radius = 0.5}});
  add_body(scene, {0.1, 2.7, 0.05}, {0, -3, 0});
  World world(scene, {.frame_time = 1.0 / 120, .integrator = {"implicit", 1}});
  EXPECT_LT(max_gained(world, 120), 0.1);
}

TEST(Implicit, RestsWhereExplicitStepsRest) {
  double height[2], energy[2];
  for (const bool implicit : {false, true}) {
    World world(ball_above_ground(1e3, 0.55), {.integrator = {implicit ? "implicit" : "semi-implicit-euler"}});
    run(world, 180);
    height[implicit] = motion(world, 0).centre.y;
    energy[implicit] = measure(world).energy;
  }
  EXPECT_NEAR(height[1], height[0], 1e-3 * 0.5);
  EXPECT_NEAR(energy[1], energy[0], 1e-3 * 9.81 * 0.5);
}

/// What `auto` moves the bodies of a scene with in its first frame, which StepController chooses by numbers alone.
struct Choice {
  const char* name;
  Scene scene;
  double frame_time;  // s
  const char* integrator;
};

Scene of_stiffness(double stiffness, double height, double size = 0.5) {
  Scene scene = ball_above_ground(stiffness, height);
  scene.bodies[0].mesh.radius = size;
  return scene;
}
Scene without_gas() {
  Scene scene = ball_above_ground(300, 0.8);
  scene.materials[0][GasPressure::inside] = scene.materials[0][GasPressure::outside] = 0;
  return scene;
}
/// A sheet is as stiff however long it is made; only the rounding of its positions grows.
Scene stiff_sheet(double width, double depth) {
  Scene scene = sheet_on_ground(0, glm::dvec3(0.0), glm::dvec3(0.0));
  remove_solids<Ground>(scene);
  scene.materials[0][StructuralSprings::stiffness] = 1e5;
  scene.bodies[0].mesh.width = width, scene.bodies[0].mesh.depth = depth;
  return scene;
}

TEST(Auto, ChoosesByWhatTheBodiesAreLike) {
  const Choice choices[]{
      {"few substeps", without_gas(), 1.0 / 60, "semi-implicit-euler"},
      {"stiff by its gas", of_stiffness(300, 0.8), 1.0 / 60, "imex-euler"},
      {"a frame too short for the gas to matter", of_stiffness(300, 0.8), 1e-3, "semi-implicit-euler"},
      {"stiff", of_stiffness(1e9, 0.8), 1.0 / 60, "implicit"},
      {"in flight", of_stiffness(2e5, 3), 1.0 / 60, "implicit"},
      {"far from the ground", of_stiffness(1e4, 1000), 1.0 / 60, "semi-implicit-euler"},
      {"near", of_stiffness(1e5, 2), 1.0 / 240, "semi-implicit-euler"},
      {"so large that rounding would keep it trembling", of_stiffness(1e5, 2, 4), 1.0 / 240, "implicit"},
      {"a small sheet", stiff_sheet(1, 1), 1.0 / 240, "semi-implicit-euler"},
      {"a wide sheet", stiff_sheet(10, 1), 1.0 / 240, "implicit"},
      {"a deep sheet", stiff_sheet(1, 10), 1.0 / 240, "implicit"},
  };
  for (const Choice& c : choices) {
    World world(c.scene, {.frame_time = c.frame_time});
    world.step();
    EXPECT_EQ(world.last_step().integrator->key, c.integrator) << c.name << ": " << world.last_step().why;
    EXPECT_FALSE(world.last_step().why.empty()) << c.name;
  }
}

/// An implicit step costs far more in contact than in flight.
TEST(Auto, TakesMoreExplicitSubstepsInContactThanInFlight) {
  Scene scene = ball_above_ground(2e5, 3);
  scene.sleep = {};
  World world(scene, {});
  while (world.frame() < 90 && WorldTestAccess::solid_impulse(world, 0).y <= 0) world.step();
  ASSERT_LT(world.frame(), 90) << "it should have come to the ground";
  EXPECT_EQ(world.last_step().integrator->key, "semi-implicit-euler") << world.last_step().why;
}

/// Light balls with stiff contacts that lie on each other: hundreds of explicit substeps are cheaper than a few
/// implicit ones.
TEST(Auto, StaysExplicitInAHeap) {
  Scene scene = find_scene("A", SBCOLLIDE_SCENES);
  scene.materials[0][Material::mass] = 0.012;
  scene.materials[0][contact::stiffness] *= 65;
  World world(scene, {});
  int most = 0;
  for (int frame = 0; frame < 60; ++frame) {
    world.step();
    most = std::max(most, world.last_step().substeps);
    ASSERT_FALSE(world.last_step().integrator->implicit) << frame;
  }
  EXPECT_GT(most, 300) << "a lone body on a solid would have been moved by implicit steps";
}

}  // namespace THIS_FILE
}  // namespace softbody::test
