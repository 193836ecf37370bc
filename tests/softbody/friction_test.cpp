// Coulomb friction on solids, by closed forms.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "softbody/contact/kernels.h"
#include "softbody/contact/solid_law.h"
#include "softbody/contact/solid_shapes.h"
#include "tests/every_target.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

constexpr double g = 9.81;
const glm::dvec3 down(0, -g, 0);

TEST(Friction, ASlidingSheetLosesMuGTAndStops) {
  for (const double mu : {0.2, 0.6}) {
    const double v0 = 2;
    World world(sheet_on_ground(mu, down, glm::dvec3(0, 0, v0)), {});
    for (int frame = 1; frame <= 120; ++frame) {
      world.step();
      const double t = frame / 60.0;
      const Motion m = motion(world, 0);
      ASSERT_NEAR(m.velocity.z, std::max(0.0, v0 - mu * g * t), 1e-4) << "mu " << mu << ", frame " << frame;
      ASSERT_NEAR(m.centre.y, 0, 1e-6);
    }
    const Motion end = motion(world, 0);
    EXPECT_EQ(measure(world).max_speed, 0) << "it stands";
    EXPECT_NEAR(end.centre.z, v0 * v0 / (2 * mu * g), 0.01);
  }
}

/// Gravity at an angle is a slope.
TEST(Friction, HoldsBelowTheConeAndSlidesAboveItByTheClosedForm) {
  const double mu = 0.5;
  for (const double tangent : {0.3, 0.49, 0.51, 0.9}) {
    const double angle = std::atan(tangent);
    World world(sheet_on_ground(mu, g * glm::dvec3(std::sin(angle), -std::cos(angle), 0), glm::dvec3(0.0)), {});
    run(world, 60);
    const double expected = std::max(0.0, g * (std::sin(angle) - mu * std::cos(angle)));
    EXPECT_NEAR(motion(world, 0).velocity.x, expected, 1e-4) << "tangent " << tangent;
    if (tangent < mu) {
      EXPECT_LT(std::abs(motion(world, 0).centre.x), 1e-6);
    }
  }
}

constexpr SphereShape<float> unit_sphere{1};

/// The kernels on their own: one particle a lane.
class SolidKernels : public tests::OnEveryTarget {
 protected:
  SolidKernels() { std::fill_n(moves, lanes, 1.0f); }
  SolidArguments arguments(double friction, const SolidShape<float>& shape = PlaneShape<float>{{0, 1, 0}}) {
    SolidArguments s{.particles = 1,
                     .mass = 0.25f,
                     .friction = float(friction),
                     .restitution = 0,
                     .shape = shape,
                     .place = {},
                     .moves = moves,
                     .sums = {field(impulse), returned, energy}};
    s.h = 0.01f;
    return s;
  }
  void act(const SolidArguments& s) { act_by_solid(lanes, lanes, s, std::as_const(x).field(), v.field()); }

  float moves[lanes], returned[lanes]{}, energy[lanes]{};
  LaneVector impulse{};
  LaneField x{1}, v{1};
};

TEST_P(SolidKernels, LeaveParticlesThatDoNotReachTheSurfaceAlone) {
  for (int l = 0; l < lanes; ++l) {
    x.set(0, l, {0, 0.05, 0});
    v.set(0, l, {1, -0.3 * l, 0});  // the last one reaches 0.005 m
  }
  act(arguments(1));
  for (int l = 0; l < lanes; ++l) {
    EXPECT_EQ(v.at(0, l).x, 1);
    EXPECT_EQ(impulse.y[l], 0);
  }
}

TEST_P(SolidKernels, StopAParticleAtTheSurfaceAndTakeFrictionTimesTheImpulse) {
  const double gap = 0.02, h = 0.01;
  for (int l = 0; l < lanes; ++l) {
    x.set(0, l, {0, gap, 0});
    v.set(0, l, {3, -3.0 - l, 4});  // 2 m/s is as fast as it may go
  }
  act(arguments(0.5));
  for (int l = 0; l < lanes; ++l) {
    const double change = 3.0 + l - gap / h, kept = std::max(0.0, 1 - 0.5 * change / 5);
    EXPECT_NEAR(v.at(0, l).y, -gap / h, 1e-5);
    EXPECT_NEAR(v.at(0, l).x, 3 * kept, 1e-5);
    EXPECT_NEAR(v.at(0, l).z, 4 * kept, 1e-5);
    EXPECT_NEAR(impulse.y[l], 0.25 * change, 1e-5);
  }
}

TEST_P(SolidKernels, NeverPullAndNeverReverseASlip) {
  for (int l = 0; l < lanes; ++l) {
    x.set(0, l, {0, 0, 0});
    v.set(0, l, l % 2 ? glm::dvec3(1, 2, 0) : glm::dvec3(0.1, -5, 0));
  }
  act(arguments(10));
  for (int l = 0; l < lanes; ++l) {
    if (l % 2) {
      EXPECT_EQ(v.at(0, l), glm::dvec3(1, 2, 0));
    } else {
      EXPECT_NEAR(glm::length(v.at(0, l)), 0, 1e-6);
    }
  }
}

TEST_P(SolidKernels, BringAParticleOutByATenthOfItsDepthAStepAtMost1MetreASecond) {
  for (int l = 0; l < lanes; ++l) x.set(0, l, {0, -0.04 * l, 0});
  act(arguments(0));
  for (int l = 0; l < lanes; ++l) EXPECT_NEAR(v.at(0, l).y, std::min(0.1 * 0.04 * l / 0.01, 1.0), 1e-5);
}

TEST_P(SolidKernels, OfASphereActWhereverTheLawDoesAndNowhereElse) {
  SolidArguments s = arguments(0.25, SphereShape<float>{3});
  std::mt19937 random(10);
  int acted = 0;
  for (int round = 0; round < 20'000; ++round) {
    simd::Vec<float> expected[lanes];
    for (int l = 0; l < lanes; ++l) {
      const auto direction = [&] { return glm::normalize(random_vector(random, 1)); };
      const double gap = uniform(random, -1, 1) * std::pow(10, uniform(random, -7, 0.5));  // m
      const glm::dvec3 n = direction();
      x.set(0, l, (3 + gap) * n);
      v.set(0, l, -gap / s.h * uniform(random, 0.9, 1.1) * n + uniform(random, 0, 1) * direction());
      const glm::dvec3 at = x.at(0, l), speed = v.at(0, l);
      const auto surface =
          simd::surface_at(SphereShape<float>{3}, simd::Vec<float>{float(at.x), float(at.y), float(at.z)});
      expected[l] = {float(speed.x), float(speed.y), float(speed.z)};
      float given = 0, back = 0;
      acted += simd::respond(s, 1.0f, surface.distance, surface.normal, {}, expected[l], given, back) > 0;
    }
    act(s);
    for (int l = 0; l < lanes; ++l)
      ASSERT_EQ(v.at(0, l), glm::dvec3(expected[l].x, expected[l].y, expected[l].z)) << "lane " << l;
  }
  EXPECT_GT(acted, 20'000 * lanes / 8);
  EXPECT_LT(acted, 20'000 * lanes * 7 / 8);
}

TEST_P(SolidKernels, PushAParticleAtASpheresCentreUpAndLeaveHeldBodiesAlone) {
  moves[3] = 0;
  act(arguments(1, unit_sphere));
  for (int l = 0; l < lanes; ++l) EXPECT_EQ(v.at(0, l), glm::dvec3(0, l == 3 ? 0 : 1, 0));
}

INSTANTIATE_TEST_SUITE_P(All, SolidKernels, testing::ValuesIn(tests::targets()), tests::target_name);

}  // namespace THIS_FILE
}  // namespace softbody::test
