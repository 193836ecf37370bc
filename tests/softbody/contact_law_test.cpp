// The law of contact by itself, by closed forms: for a float and a double alike; lane_math_test.cpp has the lanes.

#include "softbody/contact/law.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <vector>

namespace softbody::test {
namespace THIS_FILE {

constexpr double h = 1.0 / 1024;  // s; a power of two, so that a length over it is exact

/// From far outside to deep inside.
const std::vector<double> gaps{10, 1, 0.5, 1e-3, 1e-9, 0, -1e-9, -1e-4, -1e-3, -0.009, -0.011, -0.5, -10};

TEST(ContactLaw, LetsAGapCloseButNoFurther) {
  for (const double gap : gaps)
    if (gap > 0) {
      EXPECT_EQ(law::min_move(gap, h), -gap);
      EXPECT_EQ(law::min_speed(gap, 1 / h), -gap / h);
    }
}

TEST(ContactLaw, PushesOutAShareOfTheDepthAtABoundedSpeed) {
  for (const double gap : gaps)
    if (gap <= 0) {
      EXPECT_DOUBLE_EQ(law::min_move(gap, h), std::min(-gap / 10, h));
      EXPECT_DOUBLE_EQ(law::min_speed(gap, 1 / h), std::min(-gap / (10 * h), 1.0));
    }
}

TEST(ContactLaw, ReturnsAShareOfTheKineticEnergyThatAnImpulseTakes) {
  constexpr double mass = 0.25;
  for (const double e : {0.0, 0.5, 1.0})
    for (const double before : {-3.0, -1.0, 0.0})
      for (const double after : {-1.0, 0.0, 2.0})
        EXPECT_NEAR(law::bounce_energy(mass * (after - before), before, after, e),
                    e * e * mass / 2 * (before * before - after * after), 1e-15);
}

TEST(ContactLaw, LimitsFrictionToTheCone) {
  const std::vector<glm::dvec3> drags{{0, 0, 0}, {3, 0, -4}, {1e-9, 2e-9, 0}, {-7e5, 1e3, 12}, {0, 1e-30, 0}};
  for (const glm::dvec3& drag : drags)
    for (const double limit : {0.0, 1e-12, 0.5, 4.999, 5.0, 1e9}) {
      const glm::dvec3 held = law::within_cone(drag, limit);
      EXPECT_LE(glm::length(held), limit * (1 + 1e-15));
      EXPECT_LE(glm::length(glm::cross(held, drag)), 1e-15 * glm::dot(drag, drag)) << "along it";
      EXPECT_GE(glm::dot(held, drag), 0) << "and not against it";
      if (glm::length(drag) <= limit)
        EXPECT_EQ(held, drag) << "it sticks";
      else
        EXPECT_NEAR(glm::length(held), limit, 1e-15 * limit) << "it slides";
    }
}

TEST(ContactLaw, MixesTheMaterialsOfBothSides) {
  EXPECT_EQ(law::common_friction(0.5, 0.5), 0.5);
  EXPECT_EQ(law::common_friction(0.25, 1.0), 0.5);
  EXPECT_EQ(law::common_friction(0.7, 0.0), 0) << "smooth on one side is smooth";
  EXPECT_EQ(law::common_friction(0.2f, 0.9f), law::common_friction(0.9f, 0.2f));
  EXPECT_EQ(law::common_restitution(0.2, 0.9), 0.9);
  EXPECT_EQ(law::common_restitution(0.9, 0.2), 0.9);
}

}  // namespace THIS_FILE
}  // namespace softbody::test
