// Volume and pressure kernels, and the law of the gas.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "softbody/mechanics/kernels.h"
#include "softbody/mechanics/visit.h"
#include "tests/every_target.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

struct Solid {
  std::vector<glm::dvec3> corners;
  std::vector<Triangle> faces;
  double volume;
};

Solid tetrahedron() {
  return {{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}, 4};
}

Solid cube() {
  return {{{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 3}, {1, 0, 3}, {1, 2, 3}, {0, 2, 3}},
          {{0, 2, 1},
           {0, 3, 2},
           {4, 5, 6},
           {4, 6, 7},
           {0, 1, 5},
           {0, 5, 4},
           {2, 3, 7},
           {2, 7, 6},
           {1, 2, 6},
           {1, 6, 5},
           {3, 0, 4},
           {3, 4, 7}},
          6};
}

Solid ball(int subdivisions) {
  const Mesh mesh = icosphere(subdivisions, 1);
  double volume = 20;  // of pyramids over the icosahedron's faces
  if (subdivisions == 0)
    volume *= 5 * (3 + std::sqrt(5.0)) / 12 / 20 * std::pow(std::sqrt(50 - 10 * std::sqrt(5)) / 5, 3);
  else
    volume = softbody::volume(mesh.vertices, mesh.triangles);
  return {mesh.vertices, mesh.triangles, volume};
}

/// A model of a solid that holds this gas.
BodyModel model_of(const Solid& solid, const Gas& gas) {
  Mesh mesh;
  mesh.vertices = solid.corners;
  mesh.triangles = solid.faces;
  return with_force<GasPressure>(*make_body_mesh(std::move(mesh)), gas);
}

/// Each lane larger than the one before.
double scale(int lane) { return 0.5 + 0.25 * lane; }
LaneField positions(const Solid& solid) {
  LaneField x(solid.corners.size());
  for (std::size_t i = 0; i < solid.corners.size(); ++i)
    for (int l = 0; l < lanes; ++l) x.set(i, l, scale(l) * solid.corners[i]);
  return x;
}

class Pressure : public tests::OnEveryTarget {
 protected:
  const ForceKernels& k = force_kernels(lanes);
  std::vector<Solid> solids{tetrahedron(), cube(), ball(0), ball(2)};
  /// Some with more pressure inside than outside.
  Gas gas_of(const Solid& solid) const {
    return {.amount = 100 * solid.volume, .ambient = 100, .rest_volume = solid.volume};
  }
};

TEST_P(Pressure, VolumesHaveTheirClosedForms) {
  for (const Solid& solid : solids) {
    SurfaceShape shapes[lanes];
    LaneField area(solid.corners.size());
    k.measure_surfaces({model_of(solid, gas_of(solid)), lanes, positions(solid).field(), area.field()}, shapes);
    for (int l = 0; l < lanes; ++l) {
      const double expected = solid.volume * std::pow(scale(l), 3);
      EXPECT_NEAR(shapes[l].volume, expected, 4e-6 * expected) << solid.corners.size() << " corners, lane " << l;
    }
  }
}

TEST_P(Pressure, NetForceAndTorqueVanishAndGaugeZeroPushesNowhere) {
  for (const Solid& solid : solids)
    for (const double amount : {0.0, 1.0, 3e4}) {
      const LaneField x = positions(solid);
      LaneField f(solid.corners.size());
      const Gas inside{.amount = amount, .rest_volume = solid.volume};
      k.add[index_of<GasPressure>]({model_of(solid, inside), lanes, x.field(), f.field()}, {x.field()});
      for (int l = 0; l < lanes; ++l) {
        glm::dvec3 sum(0.0), torque(0.0);
        double size = 0;
        for (std::size_t i = 0; i < solid.corners.size(); ++i) {
          sum += f.at(i, l);
          torque += glm::cross(x.at(i, l), f.at(i, l));
          size += glm::length(f.at(i, l));
        }
        EXPECT_EQ(size > 0, amount != 0);
        EXPECT_LE(glm::length(sum), 1e-6 * size);
        EXPECT_LE(glm::length(torque), 4e-6 * size);
      }
    }
}

INSTANTIATE_TEST_SUITE_P(All, Pressure, testing::ValuesIn(tests::targets()), tests::target_name);

const Gas gas{.amount = 60000, .ambient = 101325, .rest_volume = 0.5};

TEST(GasLaw, PressureTimesVolumeIsConstantDownToATenth) {
  for (const double v : {0.05, 0.0501, 0.1, 0.3, 0.5, 2.0, 50.0}) EXPECT_NEAR(gas.pressure(v) * v, 60000, 1e-9 * 60000);
}

TEST(GasLaw, GoesOnLinearlyBelowATenthWithTheSameValueAndSlope) {
  const double turn = 0.05, p = 60000 / turn, slope = -60000 / (turn * turn);
  for (const double v : {0.04999, 0.03, 0.0, -0.01, -0.5, -2.0})
    EXPECT_NEAR(gas.pressure(v), p + slope * (v - turn), 1e-9 * gas.pressure(v)) << v;
  EXPECT_NEAR(gas.pressure(turn * (1 - 1e-9)), gas.pressure(turn * (1 + 1e-9)), 1e-7 * p);
  const double below = (gas.pressure(turn) - gas.pressure(turn - 1e-7)) / 1e-7;
  const double above = (gas.pressure(turn + 1e-7) - gas.pressure(turn)) / 1e-7;
  EXPECT_NEAR(below, slope, 1e-4 * -slope);
  EXPECT_NEAR(above, slope, 1e-4 * -slope);
}

TEST(GasLaw, AnInvertedBodyFeelsAFiniteOutwardPressureThatGrows) {
  double last = gas.pressure(0.05);
  for (double v = 0.04; v > -1; v -= 0.01) {
    EXPECT_GT(gas.pressure(v), last);
    last = gas.pressure(v);
  }
  EXPECT_TRUE(std::isfinite(last));
}

TEST(GasLaw, WhatIsAroundPressesOnTheOuterSideOfAnInvertedBodyToo) {
  for (const double v : {0.05, 0.5, 3.0}) EXPECT_NEAR(gas.ambient_pressure(v), 101325, 1e-9);
  for (const double v : {-0.05, -0.5, -3.0}) EXPECT_NEAR(gas.ambient_pressure(v), -101325, 1e-9);
  for (const double v : {-0.04, 0.0, 0.01}) EXPECT_NEAR(gas.ambient_pressure(v), 101325 * v / 0.05, 1e-9);
}

TEST(GasLaw, SlopeIsTheGaugesAndNeverPositive) {
  const auto slope = [](double v) { return -gas.pull(Jet(v, 1)).slope; };
  for (const double v : {-0.7, -0.02, 0.0, 0.03, 0.06, 0.5, 3.0}) {
    const double e = 1e-6;
    EXPECT_NEAR(slope(v), (gas.gauge(v + e) - gas.gauge(v - e)) / (2 * e), 1e-6 * -slope(v)) << "V = " << v;
    EXPECT_LT(slope(v), 0);
  }
}

TEST(GasLaw, AnEmptyBodyHasLeastEnergyWhereItIsFlat) {
  const Gas none{.amount = 0, .ambient = 101325, .rest_volume = 0.5};
  for (const double v : {-100.0, -0.5, -0.05, -0.01, 0.01, 0.05, 0.5, 100.0}) {
    EXPECT_GT(none.stored(v), none.stored(0)) << "V = " << v;
    EXPECT_EQ(none.gauge(v) > 0, v < 0) << "V = " << v;
  }
}

TEST(GasLaw, EnergyIsThePotentialOfThePressureOnBothSides) {
  for (const double v : {-0.7, -0.05, -1e-3, 0.0, 1e-3, 0.02, 0.049, 0.05, 0.051, 0.2, 0.5, 1.0, 3.0}) {
    const double e = 1e-6;
    const double slope = (gas.stored(v + e) - gas.stored(v - e)) / (2 * e);
    EXPECT_NEAR(slope, -gas.gauge(v), 1e-5 * (gas.ambient + gas.pressure(v))) << "V = " << v;
  }
  EXPECT_EQ(gas.stored(0.5), 0.0);
  EXPECT_NEAR(gas.stored(0.05 - 1e-12), gas.stored(0.05 + 1e-12), 1e-4) << "no jump at the turn";
}

/// With nothing inside there is no volume at which what is around would let it rest but none.
TEST(Gas, ABodyWithoutAnyFallsFlatAndIsNotBlownUp) {
  Material m = gas_ball();
  m[GasPressure::inside] = 0;
  m[GasPressure::outside] = 101325;
  m[Material::start_in_equilibrium] = false;
  World world(lone_body(m), {});
  const double energy = measure(world).energy;
  for (int frame = 0; frame < 120; ++frame) {
    world.step();
    const Measures now = measure(world);
    ASSERT_TRUE(now.finite) << frame;
    ASSERT_LT(now.energy, energy * (energy > 0 ? 1.01 : 0.99)) << frame;
    ASSERT_GT(now.volume_ratio_min, -0.5) << frame;
  }
  EXPECT_LT(std::abs(measure(world).volume_ratio_min), 0.1);
}

/// Where the law bends, Newton's method alone would leap to and fro.
TEST(PressureAtEnd, IsTheRootWhateverTheGas) {
  for (const double inside : {0.0, 1e3, 1e4, 113e3})
    for (const double volume : {-0.3, 0.055, 0.3, 0.6})
      for (const double drift : {-0.5, -0.01, 0.0, 0.2})
        for (const double yield : {1e-9, 1e-6, 4e-5}) {
          const Gas law{.amount = inside * 0.52, .ambient = 101'325, .rest_volume = 0.52};
          const auto excess = [&](double pressure) {  // falls with the pressure
            return law.gauge(volume + drift + yield * pressure) - pressure;
          };
          double low = -1e9, high = 1e9;
          for (int i = 0; i < 100; ++i) (excess((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
          const double found =
              simd::pressure_at_end({volume, drift, yield}, 0.52, [&](double v) { return law.pull(Jet(v, 1)); });
          EXPECT_NEAR(found, low, 1e-3 * (std::abs(low) + law.scale()))
              << inside << " Pa, " << volume << " m^3, " << drift << ", " << yield;
        }
}

}  // namespace THIS_FILE
}  // namespace softbody::test
