#include "softbody/forces/hand.h"

#include <gtest/gtest.h>

#include <numbers>

#include <glm/geometric.hpp>

#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace {

/// It pulls at a body of three particles.
class HandOnThreeParticles : public testing::Test {
 protected:
  HandOnThreeParticles() {
    model.material[Material::mass] = 2;
    model.particle_mass = 0.5;
    x.randomise(random, 1);
    v.randomise(random, 1);
    f.randomise(random, 1);
    hand.take(grab);
  }
  static BodyField of(LaneField& field) { return {field.field(), lane, lanes}; }
  HeldBody body() { return {model, origin, of(x), of(v), of(f)}; }
  /// N, on the point, which moves at `velocity` after a step of h but for the hand.
  glm::dvec3 expected(const glm::dvec3& velocity) {
    const double rate = 2 * std::numbers::pi * grab.frequency, mass = model.material[Material::mass];
    return pull(mass * rate * rate, 2 * grab.damping_ratio * mass * rate,
                model.particle_mass / glm::dot(grab.weights, grab.weights), h, grab.target - origin - mean(of(x)),
                velocity);
  }
  /// Of the vectors at the corners, by their weights.
  glm::dvec3 mean(const BodyField& field) const {
    glm::dvec3 sum(0.0);
    for (int i = 0; i < 3; ++i) sum += grab.weights[i] * field(grab.corners[std::size_t(i)]);
    return sum;
  }

  static constexpr int lane = 2;
  static constexpr double h = 0.01;  // s
  std::mt19937 random{3};
  const Grab grab{.body = 4, .corners = {2, 0, 1}, .weights = {0.5, 0.3, 0.2}, .target = {3, 2, 1}};
  const glm::dvec3 origin{5, 0, 0};
  BodyModel model;
  LaneField x{3}, v{3}, f{3};
  Hand hand;
};

TEST_F(HandOnThreeParticles, AddsItsForceByTheWeights) {
  const glm::dvec3 gravity(0, -10, 0);
  const glm::dvec3 force = expected(mean(of(v)) + h * (gravity + mean(of(f)) / model.particle_mass));
  const LaneField x_before = x, v_before = v;
  LaneField before = f;
  hand.add_force(body(), h, gravity);
  for (int i = 0; i < 3; ++i) {
    const std::size_t corner = grab.corners[std::size_t(i)];
    EXPECT_LT(glm::distance(of(f)(corner) - of(before)(corner), grab.weights[i] * force), 1e-6 * glm::length(force));
    EXPECT_EQ(f.at(corner, 1), before.at(corner, 1)) << "another body's";
  }
  EXPECT_TRUE(x == x_before && v == v_before);
}

TEST_F(HandOnThreeParticles, AddsItsImpulseByTheWeights) {
  const glm::dvec3 change = h / model.particle_mass * expected(mean(of(v)));
  const LaneField x_before = x, f_before = f;
  LaneField before = v;
  hand.add_impulse(body(), h);
  for (int i = 0; i < 3; ++i) {
    const std::size_t corner = grab.corners[std::size_t(i)];
    EXPECT_LT(glm::distance(of(v)(corner) - of(before)(corner), grab.weights[i] * change), 1e-6 * glm::length(change));
    EXPECT_EQ(v.at(corner, 1), before.at(corner, 1)) << "another body's";
  }
  EXPECT_TRUE(x == x_before && f == f_before);
}

TEST_F(HandOnThreeParticles, FollowsItsBodyWhenOthersGo) {
  hand.remove(5);
  EXPECT_TRUE(hand.holds(4));
  hand.remove(1);
  EXPECT_TRUE(hand.holds(3));
  hand.remove(3);
  EXPECT_FALSE(hand.grab());
}

}  // namespace
}  // namespace softbody::test
