#include "collide/core/cutoff.h"

#include <gtest/gtest.h>

#include "collide/core/aabb.h"
#include "states.h"

namespace collide::test {
namespace THIS_FILE {

TEST(ContactCutoff, BoundsEveryPairThatThePredicateAccepts) {
  std::mt19937 random(11);
  int accepted = 0;
  for (const float tolerance : {0.1f, 1e6f, min_tolerance, 1e-9f, 1e9f, max_tolerance}) {
    const float cutoff = contact_cutoff(tolerance);
    for (int i = 0; i < 20000; ++i) {
      // One tolerance apart, give or take the last few bits, along a random direction.
      const glm::vec3 direction = random_points(random, 1, -1, 1)[0];
      const auto length = static_cast<float>(distance(direction, glm::vec3(0)));
      const glm::vec3 a = random_points(random, 1, -tolerance, tolerance)[0];
      const float step = tolerance * (1 + uniform(random, -3e-7f, 3e-7f)) / length;
      const glm::vec3 b = a + direction * step;
      if (!(squared_distance(a.x, a.y, a.z, b.x, b.y, b.z) < tolerance * tolerance)) continue;
      ++accepted;
      ASSERT_LE(distance(a, b), static_cast<long double>(cutoff)) << tolerance;
    }
  }
  EXPECT_GT(accepted, 10000);
}

/// Found by search: rounding brings them within the tolerance from more than (1 + u) times it, u = 2^-24.
TEST(ContactCutoff, BoundsPairsThatRoundingBringsNearest) {
  struct Case {
    float tolerance;
    glm::vec3 a, b;
  };
  const Case cases[] = {
      {0.179644078f, {-0.115869626f, -0.00222480949f, -0.110088803f}, {0.0105839735f, 0.124703094f, -0.0970199481f}},
      {0.192625374f, {0.108097374f, 0.0131377773f, -0.0594537333f}, {-0.0351010635f, 0.0363095812f, 0.0672814846f}}};
  for (const auto& [tolerance, a, b] : cases) {
    ASSERT_LT(squared_distance(a.x, a.y, a.z, b.x, b.y, b.z), tolerance * tolerance);
    EXPECT_LE(distance(a, b), static_cast<long double>(contact_cutoff(tolerance)));
  }
}

TEST(ContactCutoff, IsHardlyMoreThanTheTolerance) {
  for (const float tolerance : {1e-15f, 0.1f, 1e6f}) {
    EXPECT_GE(contact_cutoff(tolerance), tolerance);
    EXPECT_LE(contact_cutoff(tolerance), tolerance * 1.000001f);
  }
}

TEST(Aabb, IsNearUpToTheReachItself) {
  const Aabb a{glm::vec3(0), glm::vec3(1)};
  for (int axis = 0; axis < 3; ++axis) {
    for (const float shift : {1.25f, -1.25f}) {
      Aabb b = a;
      b.lo[axis] += shift, b.hi[axis] += shift;
      EXPECT_TRUE(near(a, b, 0.25f)) << axis << " " << shift;
      EXPECT_FALSE(near(a, b, 0.2499f)) << axis << " " << shift;
    }
  }
}

}  // namespace THIS_FILE
}  // namespace collide::test
