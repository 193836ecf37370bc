// Volume and pressure kernels, and the law of the gas.

#include <gtest/gtest.h>

#include <cmath>

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

Solid ball() {
  const Mesh mesh = icosphere(2, 1);
  return {mesh.vertices, mesh.triangles, volume(mesh.vertices, mesh.triangles)};
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

class VolumeKernel : public tests::OnEveryTarget {};

TEST_P(VolumeKernel, HasItsClosedForm) {
  for (const Solid& solid : {tetrahedron(), ball()}) {
    const Gas gas{.amount = 100 * solid.volume, .ambient = 100, .rest_volume = solid.volume};
    SurfaceShape shapes[lanes];
    LaneField area(solid.corners.size());
    force_kernels(lanes).measure_surfaces({model_of(solid, gas), lanes, positions(solid).field(), area.field()},
                                          shapes);
    for (int l = 0; l < lanes; ++l) {
      const double expected = solid.volume * std::pow(scale(l), 3);
      EXPECT_NEAR(shapes[l].volume, expected, 4e-6 * expected) << solid.corners.size() << " corners, lane " << l;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, VolumeKernel, testing::ValuesIn(tests::targets()), tests::target_name);

const Gas gas{.amount = 60000, .ambient = 101325, .rest_volume = 0.5};

TEST(GasLaw, PressureTimesVolumeIsConstantDownToATenth) {
  for (const double v : {0.05, 0.0501, 0.1, 0.3, 0.5, 2.0, 50.0}) EXPECT_NEAR(gas.pressure(v) * v, 60000, 1e-9 * 60000);
}

TEST(GasLaw, GoesOnLinearlyBelowATenthWithTheSameValueAndSlope) {
  const double turn = 0.05, p = 60000 / turn, slope = -60000 / (turn * turn);
  for (const double v : {0.04999, 0.03, 0.0, -0.01, -0.5, -2.0})
    EXPECT_NEAR(gas.pressure(v), p + slope * (v - turn), 1e-9 * gas.pressure(v)) << v;
}

TEST(GasLaw, SurroundingsPressOnTheOuterSideOfAnInvertedBodyToo) {
  for (const double v : {0.05, 0.5, 3.0}) EXPECT_NEAR(gas.ambient_pressure(v), 101325, 1e-9);
  for (const double v : {-0.05, -0.5, -3.0}) EXPECT_NEAR(gas.ambient_pressure(v), -101325, 1e-9);
  for (const double v : {-0.04, 0.0, 0.01}) EXPECT_NEAR(gas.ambient_pressure(v), 101325 * v / 0.05, 1e-9);
}

TEST(GasLaw, SlopeIsTheGaugesAndNeverPositive) {
  const auto slope = [](double v) { return -gas.pull(Jet(v, 1)).slope; };
  for (const double v : {-0.7, -0.02, 0.0, 0.03, 0.06, 0.5, 3.0}) {
    const double e = 1e-6;
    EXPECT_NEAR(slope(v), -(gas.pull(v + e) - gas.pull(v - e)) / (2 * e), 1e-6 * -slope(v)) << "V = " << v;
    EXPECT_LT(slope(v), 0);
  }
}

TEST(GasLaw, EnergyIsThePotentialOfThePressureOnBothSides) {
  for (const double v : {-0.7, -0.05, -1e-3, 0.0, 1e-3, 0.02, 0.049, 0.05, 0.051, 0.2, 0.5, 1.0, 3.0}) {
    const double e = 1e-6;
    const double slope = (gas.stored(v + e) - gas.stored(v - e)) / (2 * e);
    EXPECT_NEAR(slope, gas.pull(v), 1e-5 * (gas.ambient + gas.pressure(v))) << "V = " << v;
  }
  EXPECT_EQ(gas.stored(0.5), 0.0);
  EXPECT_NEAR(gas.stored(0.05 - 1e-12), gas.stored(0.05 + 1e-12), 1e-4) << "no jump at the turn";
}

/// Where the law bends, Newton's method alone would leap to and fro.
TEST(PressureAtEnd, IsTheRootWhateverTheGas) {
  for (const double inside : {0.0, 1e3, 1e4, 113e3})
    for (const double volume : {-0.3, 0.055, 0.3, 0.6})
      for (const double drift : {-0.5, -0.01, 0.0, 0.2})
        for (const double yield : {1e-9, 1e-6, 4e-5}) {
          const Gas law{.amount = inside * 0.52, .ambient = 101'325, .rest_volume = 0.52};
          const auto excess = [&](double pressure) {  // falls with the pressure
            return -law.pull(volume + drift + yield * pressure) - pressure;
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
