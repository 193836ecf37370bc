// The starting shape, in which springs and gas are in balance.

#include "softbody/mechanics/make_body_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

double largest(const std::vector<glm::dvec3>& vectors) {
  double size = 0;
  for (const auto& v : vectors) size = std::max(size, glm::length(v));
  return size;
}

TEST(Equilibrium, LeavesNoForceBehind) {
  for (const double pressure : {101325.0, 103000.0, 113000.0, 90000.0}) {
    Material m = gas_ball();
    m[GasPressure::inside] = pressure;
    const auto p = make_body_model({}, m);
    const double weight = p->particle_mass * 9.81;
    EXPECT_LT(largest(forces(*p, p->start)), 1e-3 * weight) << pressure << " Pa";
    if (pressure != 101325) {
      EXPECT_GT(largest(forces(*p, p->mesh.vertices)), weight) << "the mesh itself is not in balance";
    }
    EXPECT_NEAR(p->start_volume, volume(p->start, p->mesh.triangles), 1e-15);
    EXPECT_EQ(p->start_volume > data<GasPressure>(*p)->rest_volume * (1 + 1e-9), pressure > 101325);
  }
}

/// An icosahedron stays one, so its radius is the root of one equation: springs against gas.
TEST(Equilibrium, OfAnIcosahedronHasTheRadiusOfTheForceBalance) {
  Material m = gas_ball();
  m[GasPressure::inside] = 200000;
  MeshSource source;
  source.subdivisions = 0;
  source.radius = 0.5;
  const auto p = make_body_model(source, m);
  const double edge = std::sqrt(50 - 10 * std::sqrt(5.0)) / 5;  // of the unit radius
  const double golden = (1 + std::sqrt(5.0)) / 2;               // a bend pair is that many edges apart
  const double unit_volume = 5 * (3 + std::sqrt(5.0)) / 12 * std::pow(edge, 3);
  const double v0 = unit_volume * 0.125;
  // dE/dr: 30 springs of each kind, k (L - L0) dL/dr, against (P - ambient) dV/dr.
  const auto slope = [&](double r) {
    const double v = unit_volume * r * r * r;
    return 30 * (200 * edge * edge + 50 * golden * golden * edge * edge) * (r - 0.5) -
           (200000 * v0 / v - 101325) * 3 * unit_volume * r * r;
  };
  double lo = 0.5, hi = 1;
  for (int i = 0; i < 200; ++i) (slope((lo + hi) / 2) < 0 ? lo : hi) = (lo + hi) / 2;
  ASSERT_GT(lo, 0.55);
  for (const auto& v : p->start) EXPECT_NEAR(glm::length(v), lo, 1e-6);
  EXPECT_NEAR(p->start_volume, unit_volume * lo * lo * lo, 1e-6);
}

/// The volume is summed in float, and its last digits make a gas of 1 bar breathe a little.
TEST(Equilibrium, ABodyThatStartsInItStaysAtRest) {
  for (const bool gas : {false, true}) {
    Material m = gas ? gas_ball() : spring_ball();
    m[Material::internal_damping] = 10;
    World world(lone_body(m), {});
    for (int i = 0; i < 240; ++i) {
      world.step();
      ASSERT_LT(measure(world).max_speed, gas ? 2e-3 : 1e-4) << "frame " << i;
      ASSERT_NEAR(measure(world).volume_ratio_min, 1, 1e-5);
      ASSERT_LT(glm::length(motion(world, 0).centre), 1e-5);
      ASSERT_LT(glm::length(motion(world, 0).velocity), 1e-4);
    }
  }
}

TEST(Equilibrium, IsNotLookedForWhenTheSceneSaysSo) {
  Material m = gas_ball();
  m[Material::start_in_equilibrium] = false;
  const auto p = make_body_model({}, m);
  EXPECT_EQ(p->start, p->mesh.vertices);
  World world(lone_body(m), {});
  world.step();
  EXPECT_GT(measure(world).max_speed, 0.01) << "it breathes";
}

/// A stiff gas in a soft skin: the search must neither run away nor take a NaN for a balance.
TEST(Equilibrium, OfASoftSkinIsNearlyTheVolumeAtAmbientPressure) {
  for (const double pressure : {101400.0, 103000.0, 113000.0})
    for (const double stiffness : {2.0, 20.0, 100.0}) {
      Material m = gas_ball();
      m[StructuralSprings::stiffness] = stiffness;
      m[BendSprings::stiffness] = stiffness / 4;
      m[GasPressure::inside] = pressure;
      const auto p = make_body_model({}, m);
      EXPECT_NEAR(p->start_volume / data<GasPressure>(*p)->rest_volume, pressure / 101325, 1e-3) << stiffness << " N/m";
      EXPECT_LT(largest(forces(*p, p->start)), 1e-4);
    }
}

TEST(Equilibrium, ThatDoesNotExistIsAnErrorThatNamesTheMaterial) {
  Material m = gas_ball();
  m.name = "balloon";
  m[StructuralSprings::stiffness] = m[BendSprings::stiffness] = 1e-6;
  m[GasPressure::outside] = 0;  // nothing holds the gas back but these springs
  BodyModel broken = *make_body_model({}, gas_ball());
  broken.mesh.vertices[7].y = std::nan("");
  EXPECT_THROW(find_equilibrium(broken, broken.mesh.vertices), SceneError) << "no numbers are a balance";
  expect_error("'balloon'", [&] { make_body_model({}, m); });
}

}  // namespace THIS_FILE
}  // namespace softbody::test
