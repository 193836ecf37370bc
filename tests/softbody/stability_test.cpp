// The stability bound: sharp for one oscillator, and a bound for a body's whole stiffness matrix.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "softbody/mechanics/make_body_model.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

/// Largest |x| of the second half of a long run over that of its first steps: semi-implicit Euler with the
/// stiffness 2 k_m and the damping 2 c_m that stable_step() allows for.
double growth(double k_m, double c_m, double h) {
  double x = 1, v = 0.3 * std::sqrt(2 * k_m);
  double early = 0, late = 0;
  constexpr int steps = 4000;
  for (int i = 0; i < steps && std::abs(x) < 1e100; ++i) {
    v += h * (-2 * k_m * x - 2 * c_m * v);
    x += h * v;
    (i < 100 ? early : late) = std::max(i < 100 ? early : late, std::abs(x));
  }
  return late / early;
}

TEST(StableStep, IsEightTenthsOfTheLimitOfOneOscillator) {
  for (const double k : {1.0, 30.0, 4e3, 1e6})
    for (const double zeta : {0.0, 0.01, 0.3, 1.0, 5.0}) {
      const double c = zeta * std::sqrt(2 * k);  // gamma = 2 c = 2 zeta omega
      const double limit = stable_step(k, c) / 0.8;
      EXPECT_LT(growth(k, c, 0.99 * limit), 20) << "k " << k << ", zeta " << zeta;
      EXPECT_GT(growth(k, c, 1.05 * limit), 1e6) << "k " << k << ", zeta " << zeta;
    }
}

TEST(StableStep, IsKnownForADamperAloneAndForNothing) {
  EXPECT_DOUBLE_EQ(stable_step(0, 5), 0.8 * 2 / 10);
  EXPECT_GT(stable_step(0, 0), 1e6);
  EXPECT_NEAR(stable_step(1e-12, 5), stable_step(0, 5), 1e-9);
}

/// Largest eigenvalue of -dF/dx over the particle mass at x, by power iteration; the shift makes it the one of largest
/// size, even where squeezed springs bring negative ones.
double largest_eigenvalue(const BodyModel& model, const std::vector<glm::dvec3>& x, double shift) {
  std::mt19937 random(7);
  std::vector<glm::dvec3> mode(x.size());
  for (auto& m : mode) m = random_vector(random, 1);
  double value = 0;
  for (int iteration = 0; iteration < 400; ++iteration) {
    double norm2 = 0;
    for (const auto& m : mode) norm2 += glm::dot(m, m);
    auto more = x, less = x;
    const double e = 1e-6;
    for (std::size_t i = 0; i < x.size(); ++i) {
      mode[i] /= std::sqrt(norm2);
      more[i] += e * mode[i];
      less[i] -= e * mode[i];
    }
    const auto up = forces(model, more), down = forces(model, less);
    value = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const glm::dvec3 image = -(up[i] - down[i]) / (2 * e) / model.particle_mass;
      value += glm::dot(mode[i], image);
      mode[i] = image + shift * mode[i];
    }
  }
  return value;
}

TEST(StiffnessBound, HoldsTheLargestEigenvalueOfTheSprings) {
  const auto p = make_body_model({}, spring_ball());
  const double bound = 2 * p->forces->pair_stiffness / p->particle_mass;
  const double eigenvalue = largest_eigenvalue(*p, p->mesh.vertices, 0);
  EXPECT_LE(eigenvalue, bound);
  EXPECT_GT(eigenvalue, bound / 4) << "a bound so loose would waste substeps";
  EXPECT_DOUBLE_EQ(2 * stiffness_per_mass(*p, {.volume = 0.3}), bound) << "without gas the volume does not matter";
}

TEST(StiffnessBound, HoldsSpringsAndGasTogetherAtEverySizeFlatAndInverted) {
  for (const double stiffness : {200.0, 20.0})
    for (const glm::dvec3& scale : {glm::dvec3(0.5), glm::dvec3(0.7), glm::dvec3(1), glm::dvec3(1.15), glm::dvec3(1.4),
                                    glm::dvec3(1, 0.3, 1), glm::dvec3(1, -0.2, 1), glm::dvec3(1, -1, 1)}) {
      Material m = gas_ball();
      m[StructuralSprings::stiffness] = stiffness;
      m[BendSprings::stiffness] = stiffness / 4;
      m[GasPressure::inside] = 103000;
      const auto p = make_body_model({}, m);
      auto x = p->start;
      for (auto& v : x) v *= scale;
      const double bound = 2 * stiffness_per_mass(*p, measure_surface(*p, x));
      const double eigenvalue = largest_eigenvalue(*p, x, bound / 2);
      EXPECT_LE(eigenvalue, bound) << "stiffness " << stiffness << ", " << scale.x << " by " << scale.y;
      if (scale.x != scale.y) continue;
      EXPECT_GT(eigenvalue, scale.x == 1 ? 0.95 * bound : bound / 4) << "stiffness " << stiffness << ", " << scale.x;
    }
}

/// Where the gas pulls along the springs' own swings, springs and gas stiff alike, and where it does not pull at all.
TEST(StiffnessBound, HoldsACrumpledBody) {
  std::mt19937 random(3);
  for (const double gas : {0.0, 100.0, 1000.0, 10000.0})
    for (const double rough : {0.02, 0.1, 0.3}) {
      Material m = spring_ball();
      m[GasPressure::inside] = gas;
      m[GasPressure::outside] = gas > 0 ? 0.9 * gas : 200;
      m[Material::start_in_equilibrium] = false;
      const auto p = make_body_model({}, m);
      auto x = p->start;
      for (auto& v : x) v += rough * p->radius * random_vector(random, 1);
      const double bound = 2 * stiffness_per_mass(*p, measure_surface(*p, x));
      EXPECT_LE(largest_eigenvalue(*p, x, bound / 2), bound) << "gas " << gas << ", rough " << rough;
      Material without = m;
      without[GasPressure::inside] = without[GasPressure::outside] = 0;
      const double springs = 2 * stiffness_per_mass(*make_body_model({}, without), {});
      EXPECT_GE(bound, springs);
      const SurfaceShape s = measure_surface(*p, x);
      const double norm = volume_pull(*p, s.volume).slope * s.area2 / p->particle_mass;
      const double geometric =
          std::abs(data<GasPressure>(*p)->pull(s.volume)) * p->largest_degree * s.two_medians / 6 / p->particle_mass;
      EXPECT_LE(bound, (springs + norm + geometric) * (1 + 1e-12)) << "no more than the sum of its parts";
    }
}

}  // namespace THIS_FILE
}  // namespace softbody::test
