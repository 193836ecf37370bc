#include "softbody/forces/hand.h"

#include <gtest/gtest.h>

#include <memory>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>

#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

/// It pulls at the last of five bodies of three particles.
class HandOnThreeParticles : public testing::Test {
 protected:
  HandOnThreeParticles() {
    const auto model = std::make_shared<BodyModel>();
    model->material[Material::mass] = mass;
    model->particle_mass = particle_mass;
    model->mesh.vertices.resize(3);
    model->start.resize(3);
    for (int i = 0; i < 5; ++i) state.add(model, origin, glm::dvec3(0.0));
    std::mt19937 random(3);
    std::uniform_real_distribution<float> number(-1, 1);
    for (VectorArray* array : {&state.x, &state.v, &state.f})
      for (auto& component : *array)
        for (float& value : component) value = number(random);
    hand.take(grab);
  }
  BodyField of(VectorArray& array) const { return state.field_of(grab.body, array); }
  ForceBatch batch() {
    const Batch& b = state.batch_of(grab.body);
    return {state, b, h, gravity, field(state.f, b.base)};
  }
  /// N, on the point, which moves at `velocity` after a step of h but for the hand.
  glm::dvec3 expected(const glm::dvec3& velocity) {
    const double rate = 2 * std::numbers::pi * grab.frequency;
    return pull(mass * rate * rate, 2 * grab.damping_ratio * mass * rate,
                particle_mass / glm::dot(grab.weights, grab.weights), h, grab.target - origin - mean(state.x),
                velocity);
  }
  /// Of the vectors at the corners, by their weights.
  glm::dvec3 mean(VectorArray& array) const {
    glm::dvec3 sum(0.0);
    for (int i = 0; i < 3; ++i) sum += grab.weights[i] * of(array)(grab.corners[std::size_t(i)]);
    return sum;
  }
  /// Expects that the corners have changed by their weights times `change` since `before`, and nothing else has.
  void expect_change(VectorArray now, VectorArray before, const glm::dvec3& change) const {
    for (int i = 0; i < 3; ++i) {
      const std::size_t corner = grab.corners[std::size_t(i)];
      const glm::dvec3 there = of(now)(corner) - of(before)(corner);
      EXPECT_LT(glm::distance(there, grab.weights[i] * change), 1e-6 * glm::length(change));
      of(now).set(corner, of(before)(corner));
    }
    EXPECT_EQ(now, before) << "another body's";
  }

  static constexpr double h = 0.01, mass = 2, particle_mass = 0.5;  // s and kg
  const Grab grab{.body = 4, .corners = {2, 0, 1}, .weights = {0.5, 0.3, 0.2}, .target = {3, 2, 1}};
  const glm::dvec3 origin{5, 0, 0}, gravity{0, -10, 0};
  State state;
  Hand hand;
};

TEST_F(HandOnThreeParticles, AddsItsForceByTheWeights) {
  const glm::dvec3 force = expected(mean(state.v) + h * (gravity + mean(state.f) / particle_mass));
  const VectorArray x = state.x, v = state.v, f = state.f;
  hand.add(batch());
  expect_change(state.f, f, force);
  EXPECT_TRUE(state.x == x && state.v == v);
}

TEST_F(HandOnThreeParticles, AddsItsImpulseByTheWeights) {
  const glm::dvec3 change = h / particle_mass * expected(mean(state.v));
  const VectorArray x = state.x, v = state.v, f = state.f;
  hand.kick(batch());
  expect_change(state.v, v, change);
  EXPECT_TRUE(state.x == x && state.f == f);
}

TEST_F(HandOnThreeParticles, FollowsItsBodyWhenOthersGo) {
  hand.remove(5);
  EXPECT_TRUE(hand.holds(4));
  hand.remove(1);
  EXPECT_TRUE(hand.holds(3));
  hand.remove(3);
  EXPECT_FALSE(hand.grab());
}

}  // namespace THIS_FILE
}  // namespace softbody::test
