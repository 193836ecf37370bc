// The law of the response to contacts, pair by pair.

#include "softbody/forces/penalty_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "softbody/forces/penalty_law.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace {

/// One pair of stiffness 100 N/m: b rests at the origin, a lies `apart` from it.
struct Pair {
  explicit Pair(const glm::dvec3& apart, double friction = 0, const glm::vec3& offset = glm::vec3(0.0f)) {
    x.set(0, 0, apart);
    penalty.thickness = 0.1f;
    penalty.pairs.push_back({.contact = {0, 1},
                             .body_a = 0,
                             .body_b = 1,
                             .vertex_a = 0,
                             .vertex_b = 1,
                             .slot_a = 0,
                             .slot_b = 1,
                             .offset = offset,
                             .normal = glm::vec3(0, 1, 0),
                             .stiffness = 100,
                             .friction = float(friction)});
    penalty.force.resize(1);
  }
  /// The force on a after `seconds` at this velocity, which stretches the friction spring.
  glm::dvec3 force(const glm::dvec3& velocity, double seconds = 0) {
    v.set(0, 0, velocity);
    penalty.evaluate({0, 1}, std::as_const(x).field(), std::as_const(v).field(), float(seconds));
    return glm::dvec3(penalty.force[0]);
  }
  PenaltyContact penalty;
  LaneField x{1}, v{1};
};

glm::dvec3 force(const glm::dvec3& apart, const glm::dvec3& velocity) { return Pair(apart).force(velocity); }

TEST(PenaltyContact, PushesAwayAlongItsNormalByItsLaw) {
  const double k = 100, h = 0.1;
  for (const double s : {-0.05, 0.0, 0.02, 0.05, 0.09})
    for (const double across : {0.0, 0.03}) {
      const double d2 = across * across + s * s, beyond2 = s < 0 ? s * s : 0;
      const double weight = 1 - (d2 - beyond2) / (h * h);
      const glm::dvec3 f = force({across, s, 0}, glm::dvec3(0.0));
      if (weight <= 0) {
        EXPECT_EQ(f, glm::dvec3(0.0));
        continue;
      }
      EXPECT_NEAR(f.y, k * weight * std::min(h - s, h), 1e-4) << "s = " << s;
      EXPECT_GT(f.y, 0) << "apart, never together";
      EXPECT_EQ(f.x, 0);
    }
}

TEST(PenaltyContact, StoresTheWorkOfItsPush) {
  for (const double from : {-0.04, 0.0, 0.03})
    for (const double across : {0.0, 0.03}) {
      double work = 0;
      constexpr double step = 1e-5;
      for (double s = from + step / 2; s < 0.1; s += step) work += step * force({across, s, 0}, glm::dvec3(0.0)).y;
      const Pair pair({across, from, 0});
      EXPECT_NEAR(pair.penalty.energy(pair.penalty.pairs[0], pair.x.field()), work, 1e-4 * work + 1e-9)
          << from << " " << across;
    }
  const Pair apart({0, 0.11, 0});
  EXPECT_EQ(apart.penalty.energy(apart.penalty.pairs[0], apart.x.field()), 0);
}

TEST(PenaltyContact, StoresWhatItsFrictionSpringsHold) {
  Pair pair({0, 0.05, 0}, 1);
  const double before = pair.penalty.energy(pair.penalty.pairs[0], std::as_const(pair.x).field());
  pair.force({0.01, 0, 0}, 0.1);  // a stretch of 1 mm
  EXPECT_NEAR(pair.penalty.energy(pair.penalty.pairs[0], std::as_const(pair.x).field()) - before, 0.5 * 100 * 1e-6,
              1e-8);
}

TEST(PenaltyContact, FadesOutWhereTheDetectorLosesSight) {
  EXPECT_NEAR(force({0, 0.0999, 0}, glm::dvec3(0.0)).y, 0, 1e-4);
  EXPECT_EQ(force({0, 0.1001, 0}, glm::dvec3(0.0)).y, 0);
  EXPECT_EQ(force({0.08, 0.08, 0}, glm::dvec3(0.0)).y, 0);
  EXPECT_GT(force({0, -0.3, 0}, glm::dvec3(0.0)).y, 5) << "but not behind the surface: it still pushes out";
}

TEST(PenaltyContact, DampsByTheSpeedOfSeparationBetweenNothingAndThreeTimes) {
  const double still = force({0, 0.05, 0}, glm::dvec3(0.0)).y;
  EXPECT_NEAR(force({0, 0.05, 0}, {0, 1, 0}).y, 0.5 * still, 1e-4);
  EXPECT_NEAR(force({0, 0.05, 0}, {0, -1, 0}).y, 1.5 * still, 1e-4);
  EXPECT_NEAR(force({0, 0.05, 0}, {0, -40, 0}).y, 3 * still, 1e-4);
  EXPECT_EQ(force({0, 0.05, 0}, {0, PenaltyLaw<double>::rebound_speed, 0}).y, 0) << "nothing is thrown back faster";
  EXPECT_EQ(force({0, 0.05, 0}, {0, 9, 0}).y, 0) << "and nothing is pulled back";
}

TEST(PenaltyContact, SeesPositionsFromTheirBodiesOrigins) {
  EXPECT_NEAR(Pair({0, 5.05, 0}, 0, {0, -5, 0}).force(glm::dvec3(0.0)).y, force({0, 0.05, 0}, glm::dvec3(0.0)).y, 1e-3);
}

TEST(PenaltyContact, FrictionIsADampedSpringUpToCoulombsLimit) {
  const glm::dvec3 near(0, 0.05, 0);
  const double push = force(near, glm::dvec3(0.0)).y, viscous = 0.5 * 100 * 0.1 / 2;  // k h / (2 v)
  const glm::dvec3 fast = Pair(near, 0.5).force({3, 0, -4});
  EXPECT_NEAR(fast.y, push, 1e-5);
  EXPECT_NEAR(fast.x, -0.5 * push * 0.6, 1e-4);
  EXPECT_NEAR(fast.z, 0.5 * push * 0.8, 1e-4);
  EXPECT_NEAR(Pair(near, 0.5).force({0.01, 0, 0}).x, -viscous * 0.01, 1e-5) << "below the limit";
  EXPECT_EQ(Pair(near, 0).force({1, 0, 0}, 1).x, 0);
  Pair sticks(near, 0.5);
  EXPECT_NEAR(sticks.force({0.1, 0, 0}, 0.1).x, -(100 * 0.01 + viscous * 0.1), 1e-4);
  EXPECT_NEAR(sticks.force(glm::dvec3(0.0), 0.1).x, -100 * 0.01, 1e-4) << "it holds at rest as well";
}

TEST(PenaltyContact, AFrictionSpringThatSlipsIsStretchedNoFurtherThanItsLimit) {
  Pair pair({0, 0.05, 0}, 0.5);
  const double limit = 0.5 * force({0, 0.05, 0}, glm::dvec3(0.0)).y;
  for (int i = 0; i < 10; ++i) EXPECT_NEAR(pair.force({2, 0, 0}, 0.1).x, -limit, 1e-4);
  EXPECT_NEAR(pair.force(glm::dvec3(0.0), 0).x, -limit, 1e-4);
  EXPECT_GT(pair.force({-0.1, 0, 0}, 2 * limit / 100 / 0.1).x, 0) << "and turns round at once";
}

TEST(PenaltyContact, FrictionSpringsArePassedOnToTheSameContactAcrossItsNewNormal) {
  Pair pair({0, 0.05, 0}, 5);
  pair.force({0.2, 0, 0}, 0.1);
  PenaltyContact next;
  for (const collide::Contact c : {collide::Contact{0, 0}, {0, 1}, {0, 2}}) {
    PenaltyPair& same = next.pairs.emplace_back(pair.penalty.pairs[0]);
    same.contact = c;
    same.normal = glm::normalize(glm::vec3(1, 1, 0));
    same.stretch = glm::vec3(0.0f);
  }
  next.carry_over(pair.penalty.pairs);
  EXPECT_EQ(next.pairs[0].stretch, glm::vec3(0.0f));
  EXPECT_NEAR(glm::distance(next.pairs[1].stretch, glm::vec3(0.01f, -0.01f, 0)), 0, 1e-6);
  EXPECT_EQ(next.pairs[2].stretch, glm::vec3(0.0f));
}

TEST(PenaltyContact, FrictionSpringsStayWithTheirContactsWhenAnEarlierBodyIsRemoved) {
  PenaltyContact penalty;
  const auto add = [&](const collide::Contact& contact, BodyId a, BodyId b, float stretch) {
    PenaltyPair& pair = penalty.pairs.emplace_back();
    pair.contact = contact, pair.body_a = a, pair.body_b = b, pair.stretch = glm::vec3(stretch, 0, 0);
  };
  // Bodies of five vertices, of which the second is removed.
  add({2, 7}, 0, 1, 1);
  add({3, 11}, 0, 2, 2);
  add({8, 12}, 1, 2, 3);
  add({10, 17}, 2, 3, 4);
  penalty.remove(1, 5, 5);
  ASSERT_EQ(penalty.pairs.size(), 2u);
  EXPECT_EQ(std::pair(penalty.pairs[0].body_a, penalty.pairs[0].body_b), std::pair(BodyId{0}, BodyId{1}));
  EXPECT_EQ(std::pair(penalty.pairs[1].body_a, penalty.pairs[1].body_b), std::pair(BodyId{1}, BodyId{2}));
  PenaltyContact next;
  for (const collide::Contact c : {collide::Contact{3, 6}, {5, 12}}) {
    next.pairs.emplace_back().contact = c;
    next.pairs.back().normal = glm::vec3(0, 1, 0);
  }
  next.carry_over(penalty.pairs);
  EXPECT_EQ(next.pairs[0].stretch, glm::vec3(2, 0, 0));
  EXPECT_EQ(next.pairs[1].stretch, glm::vec3(4, 0, 0));
}

TEST(PenaltyLaw, ItsSlopesAndBoundHoldTheDerivativeOfItsPush) {
  constexpr double k = 100, h = 0.1, friction_spring = k;
  double steepest = 0;
  for (const double across : {0.0, 0.02, 0.08})
    for (double s = -0.0495; s < 0.1; s += 0.001)
      for (const double u : {-9.0, -3.0, 0.0, 1.0}) {
        Pair pair({across, s, 0});
        pair.force({0, u, 0});  // writes the velocity
        const PenaltyContact::Slopes slopes = pair.penalty.slopes(pair.penalty.pairs[0], std::as_const(pair.x).field(),
                                                                  std::as_const(pair.v).field(), 0.01f);
        const Jet d2(s * s + across * across, 2 * s);
        const double fall =
            -PenaltyLaw<double>{k, h}.push_at_rest(Jet(s, 1), d2).slope * PenaltyLaw<double>::damping(u);
        EXPECT_LE(fall, double(slopes.spring) * (1 + 1e-5)) << "s " << s << " across " << across << " u " << u;
        steepest = std::max(steepest, fall);
      }
  EXPECT_NEAR(steepest + friction_spring, PenaltyLaw<double>::stiffness_bound(k), 0.1) << "no more than it has to be";
}

/// N s/m: how fast the force falls with the velocity at most, by its derivative; friction's limit moves with the push.
double damping(const glm::dvec3& apart, const glm::dvec3& velocity, double friction) {
  constexpr double e = 0.05;
  double most = 0;
  for (const glm::dvec3 way : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)}) {
    const glm::dvec3 less = Pair(apart, friction).force(velocity - e * way);
    most = std::max(most, glm::length(less - Pair(apart, friction).force(velocity + e * way)) / (2 * e));
  }
  return most;
}

TEST(PenaltyContact, ABoundHoldsTheDampingOfWhereItIsAndWhereItGoes) {
  for (const double friction : {0.0, 0.5, 1.2})
    for (double s = -0.03; s < 0.1; s += 0.01)
      for (const double across : {0.0, 0.02, 0.06})
        for (const glm::dvec3 u : {glm::dvec3(0.3, 0.2, 0), {0, -1, 0}, {-2, -0.5, 1}}) {
          const glm::dvec3 apart(across, s, 0);
          Pair pair(apart, friction);
          pair.force(u);  // writes the velocity
          const auto ahead = [&](double seconds) {
            return double(pair.penalty.predicted_damping(pair.penalty.pairs[0], std::as_const(pair.x).field(),
                                                         std::as_const(pair.v).field(), float(seconds)));
          };
          const double all =
              PenaltyLaw<double>{.stiffness = 100, .thickness = 0.1, .friction = friction}.damping_bound();
          for (const double t : {0.0, 0.01, 0.02}) {
            EXPECT_LE(damping(apart + t * u, u, friction), 1.001 * ahead(0.02)) << "s " << s << " t " << t;
            EXPECT_LE(ahead(t), 1.001 * all);
          }
        }
  const float all = PenaltyLaw<float>{100, 0.1f, 0.5f}.damping_bound();
  for (const double s : {0.1, 0.15, 10.0})
    for (const double across : {0.0, 0.2}) {
      Pair out({across, s, 0}, 0.5);  // of sight: the contact layer may be thinner than the tolerance
      EXPECT_LE(out.penalty.predicted_damping(out.penalty.pairs[0], std::as_const(out.x).field(),
                                              std::as_const(out.v).field(), 0.01f),
                0.5f * all);
    }
  Pair far({0, 0.08, 0}, 0.5);
  EXPECT_LT(far.penalty.predicted_damping(far.penalty.pairs[0], std::as_const(far.x).field(),
                                          std::as_const(far.v).field(), 0.01f),
            0.5f * all)
      << "a light contact is not taken for a deep one";
}

}  // namespace
}  // namespace softbody::test
