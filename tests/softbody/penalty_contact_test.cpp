// The law of the response to contacts, pair by pair.

#include "softbody/forces/penalty_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "softbody/contact/rebound.h"
#include "softbody/forces/penalty_law.h"
#include "tests/every_target.h"
#include "tests/softbody/helpers.h"
#include "tests/support/penalty_test_access.h"

namespace softbody::test {
namespace THIS_FILE {

/// One pair of stiffness 100 N/m: b rests at the origin, a lies `apart` from it.
struct Pair {
  explicit Pair(const glm::dvec3& apart, double friction = 0, const glm::vec3& offset = glm::vec3(0.0f)) {
    x.set(0, 0, apart);
    PenaltyTestAccess::layer(penalty).thickness = 0.1f;
    PenaltyTestAccess::add(penalty, {.contact = {0, 1},
                                     .body_a = 0,
                                     .body_b = 1,
                                     .slot_a = 0,
                                     .slot_b = 1,
                                     .offset = offset,
                                     .normal = glm::vec3(0, 1, 0),
                                     .stiffness = 100,
                                     .friction = float(friction),
                                     .damped_mass = 1});
    PenaltyTestAccess::group(penalty, 2);
  }
  /// The force on a after `seconds` at this velocity, which stretches the friction spring.
  glm::dvec3 force(const glm::dvec3& velocity, double seconds = 0) {
    v.set(0, 0, velocity);
    penalty.gather(x.field(), v.field());
    penalty.evaluate({0, 1}, {float(seconds), damper_limit});
    return penalty.force({0, 0});
  }
  PenaltyContact penalty;
  float damper_limit = std::numeric_limits<float>::infinity();
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
      EXPECT_NEAR(pair.penalty.energy(0, pair.x.field()), work, 1e-4 * work + 1e-9) << from << " " << across;
    }
  const Pair apart({0, 0.11, 0});
  EXPECT_EQ(apart.penalty.energy(0, apart.x.field()), 0);
}

TEST(PenaltyContact, DampsByTheSpeedOfSeparationBetweenNothingAndThreeTimes) {
  const double still = force({0, 0.05, 0}, glm::dvec3(0.0)).y;
  EXPECT_NEAR(force({0, 0.05, 0}, {0, 1, 0}).y, 0.5 * still, 1e-4);
  EXPECT_NEAR(force({0, 0.05, 0}, {0, -1, 0}).y, 1.5 * still, 1e-4);
  EXPECT_NEAR(force({0, 0.05, 0}, {0, -40, 0}).y, 3 * still, 1e-4);
  EXPECT_EQ(force({0, 0.05, 0}, {0, PenaltyLaw<double>::rebound_speed, 0}).y, 0) << "nothing is thrown back faster";
  EXPECT_EQ(force({0, 0.05, 0}, {0, 9, 0}).y, 0) << "and nothing is pulled back";
}

/// The damper makes 1.5 times the push at rest of it, at 1 m/s. Its impulse changes the speed while it acts.
TEST(PenaltyContact, GivesBackTheShareOfRestitutionOfWhatItsDamperTakes) {
  constexpr double seconds = 0.2;
  for (const double e : {0.0, 0.4, 1.0}) {
    Material material = spring_ball();
    material[Material::mass] = 2;
    State state;
    for (const double y : {0.1, 0.0}) state.add(make_unbalanced_body_model({}, material), {0, y, 0}, {0, y, 0});
    Pair pair({0, 0.05, 0});
    PenaltyTestAccess::pairs(pair.penalty).restitution[0] = float(e);
    PenaltyTestAccess::group(pair.penalty, 2);
    const double pushed = pair.force({0, -1, 0}, seconds).y, damped = pushed / 3 * seconds;
    Rebounds rebounds;
    pair.penalty.take_impacts(rebounds);
    EXPECT_EQ(rebounds.give_back(state, seconds), 0) << "they have just parted";
    EXPECT_NEAR(rebounds.give_back(state, seconds), e * e * damped * (1 - damped), 1e-6) << e;
  }
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

TEST(PenaltyContact, StretchesASlippingFrictionSpringNoFurtherThanItsLimit) {
  Pair pair({0, 0.05, 0}, 0.5);
  const double limit = 0.5 * force({0, 0.05, 0}, glm::dvec3(0.0)).y;
  for (int i = 0; i < 10; ++i) EXPECT_NEAR(pair.force({2, 0, 0}, 0.1).x, -limit, 1e-4);
  EXPECT_NEAR(pair.force(glm::dvec3(0.0), 0).x, -limit, 1e-4);
  EXPECT_GT(pair.force({-0.1, 0, 0}, 2 * limit / 100 / 0.1).x, 0) << "and turns round at once";
}

TEST(PenaltyContact, HandsFrictionSpringsOnAcrossTheNewNormal) {
  Pair pair({0, 0.05, 0}, 5);
  pair.force({0.2, 0, 0}, 0.1);
  PenaltyContact next;
  for (const collide::Contact c : {collide::Contact{0, 0}, {0, 1}, {0, 2}}) {
    PenaltyPair same = pair_of(pair.penalty.pairs(), 0);
    same.contact = c;
    same.normal = glm::normalize(glm::vec3(1, 1, 0));
    same.stretch = glm::vec3(0.0f);
    PenaltyTestAccess::add(next, same);
  }
  PenaltyTestAccess::carry_over(next, pair.penalty.pairs());
  EXPECT_EQ(pair_of(next.pairs(), 0).stretch, glm::vec3(0.0f));
  EXPECT_NEAR(glm::distance(pair_of(next.pairs(), 1).stretch, glm::vec3(0.01f, -0.01f, 0)), 0, 1e-6);
  EXPECT_EQ(pair_of(next.pairs(), 2).stretch, glm::vec3(0.0f));
}

TEST(PenaltyContact, KeepsFrictionSpringsWhenAnEarlierBodyIsRemoved) {
  PenaltyContact penalty;
  const auto add = [&](const collide::Contact& contact, BodyId a, BodyId b, float stretch) {
    PenaltyPair pair{};
    pair.contact = contact, pair.body_a = a, pair.body_b = b, pair.stretch = glm::vec3(stretch, 0, 0);
    PenaltyTestAccess::add(penalty, pair);
  };
  // Bodies of five vertices, of which the second is removed.
  add({2, 7}, 0, 1, 1);
  add({3, 11}, 0, 2, 2);
  add({8, 12}, 1, 2, 3);
  add({10, 17}, 2, 3, 4);
  penalty.remove(1, 5, 5);
  ASSERT_EQ(penalty.pairs().size(), 2u);
  EXPECT_EQ(penalty.pairs().body_a, (std::vector<BodyId>{0, 1}));
  EXPECT_EQ(penalty.pairs().body_b, (std::vector<BodyId>{1, 2}));
  PenaltyContact next;
  for (const collide::Contact c : {collide::Contact{3, 6}, {5, 12}}) {
    PenaltyPair pair{};
    pair.contact = c, pair.normal = glm::vec3(0, 1, 0);
    PenaltyTestAccess::add(next, pair);
  }
  PenaltyTestAccess::carry_over(next, penalty.pairs());
  EXPECT_EQ(pair_of(next.pairs(), 0).stretch, glm::vec3(2, 0, 0));
  EXPECT_EQ(pair_of(next.pairs(), 1).stretch, glm::vec3(4, 0, 0));
}

TEST(PenaltyLaw, HasSlopesAndABoundThatItsPushDoesNotExceed) {
  constexpr double k = 100, h = 0.1, friction_spring = k;
  double steepest = 0;
  for (const double across : {0.0, 0.02, 0.08})
    for (double s = -0.0495; s < 0.1; s += 0.001)
      for (const double u : {-9.0, -3.0, 0.0, 1.0}) {
        Pair pair({across, s, 0});
        pair.force({0, u, 0});  // writes the velocity
        const PenaltyContact::Slopes slopes =
            pair.penalty.slopes(0, std::as_const(pair.x).field(), std::as_const(pair.v).field(), 0.01f);
        const auto push = [&](double at) {
          return PenaltyLaw<double>{k, h}.push_at_rest(at, at * at + across * across);
        };
        constexpr double e = 1e-7;
        const double fall = (push(s - e) - push(s + e)) / (2 * e) * PenaltyLaw<double>{k, h}.damping(u);
        EXPECT_LE(fall, double(slopes.spring) * (1 + 1e-5)) << "s " << s << " across " << across << " u " << u;
        steepest = std::max(steepest, fall);
      }
  EXPECT_NEAR(steepest, PenaltyLaw<double>::stiffness_bound(k), 0.1) << "no more than it has to be";
  EXPECT_LE(friction_spring, PenaltyLaw<double>::stiffness_bound(k));
}

/// By the derivative of the force; friction's limit moves with the push.
TEST(PenaltyLaw, LimitsWhatItsDampersTakeOfAVelocity) {
  using Vector = simd::Vec<double>;
  constexpr double e = 0.05;  // m/s
  const Vector normal{0, 1, 0}, ways[]{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const double friction : {0.0, 0.5, 1.2}) {
    double most = 0;
    for (double s = -0.03; s < 0.1; s += 0.01)
      for (const double across : {0.0, 0.02, 0.06})
        for (const Vector& u : {Vector{0.3, 0.2, 0}, Vector{0, -1, 0}, Vector{-2, -0.5, 1}})
          for (const double limit : {1.0, 2.0, 1e6})  // N s/m
            for (const Vector& way : ways) {
              const PenaltyLaw<double> law{100, 0.1, friction, limit};
              Vector slower{0, 0, 0}, faster{0, 0, 0};
              const Vector fall = law.force({across, s, 0}, u - e * way, normal, 0.0, slower) -
                                  law.force({across, s, 0}, u + e * way, normal, 0.0, faster);
              const double found = std::sqrt(dot(fall, fall)) / (2 * e);
              EXPECT_LE(found, 1.001 * std::sqrt(1 + friction * friction) * limit + 1e-4) << "s " << s;
              if (limit < 10) most = std::max(most, found / limit);
            }
    EXPECT_GT(most, 0.9);
  }
}

TEST(PenaltyContact, KeepsTheStaticPushWhereItsDampersAreLimited) {
  for (const double s : {-0.02, 0.01, 0.05, 0.09}) {
    Pair free({0, s, 0}), limited({0, s, 0});
    limited.damper_limit = 1;
    EXPECT_NEAR(limited.force({}).y, free.force({}).y, 1e-6);
    EXPECT_LE(limited.force({0, -1, 0}).y, free.force({0, -1, 0}).y + 1e-6);
    EXPECT_GE(limited.force({0, -1, 0}).y, free.force({}).y - 1e-6);
    EXPECT_GE(limited.force({0, 1, 0}).y, free.force({0, 1, 0}).y - 1e-6);
    EXPECT_GE(limited.force({0, 100, 0}).y, -1e-6) << "it never draws";
    limited.damper_limit = 1e6f;
    EXPECT_NEAR(limited.force({0, 0.5, 0}).y, free.force({0, 0.5, 0}).y, 1e-5);
  }
}

/// Many pairs of random particles: near and far, in front of the surface and behind it, that stick and that slide.
struct RandomPairs {
  static constexpr std::size_t particles = 5, count = 203;
  RandomPairs() {
    x.randomise(random, 0.03), v.randomise(random, 0.3);
    PenaltyTestAccess::layer(penalty).thickness = 0.05f;
    std::uniform_int_distribution<std::uint32_t> slot(0, particles * lanes - 1);
    std::uniform_real_distribution<float> value(0, 1);
    const auto vector = [&](float size) {
      return size * (2.0f * glm::vec3(value(random), value(random), value(random)) - 1.0f);
    };
    for (std::size_t i = 0; i < count; ++i)
      PenaltyTestAccess::add(penalty, {.contact = {},
                                       .body_a = 0,
                                       .body_b = 1,
                                       .slot_a = slot(random),
                                       .slot_b = slot(random),
                                       .offset = vector(0.02f),
                                       .normal = glm::normalize(vector(1)),
                                       .stiffness = 100 * value(random),
                                       .friction = i % 5 == 0 ? 0 : 2 * value(random),
                                       .damped_mass = 0.01f * value(random),
                                       .stretch = vector(0.01f)});
    PenaltyTestAccess::group(penalty, particles * lanes);
    penalty.gather(x.field(), v.field());
  }
  void evaluate(const std::vector<std::size_t>& first) {  // pairs of each part
    for (std::size_t part = 0; part + 1 < first.size(); ++part)
      penalty.evaluate({first[part], first[part + 1]}, {seconds, damper_limit});
  }
  double stored_energy(int threads) {
    collide::Workers workers(threads);
    return penalty.stored_energy(workers, threads);
  }
  simd::Vec<double> way(std::size_t i, const LaneField& field) const {
    const auto at = [&](std::uint32_t slot) { return glm::dvec3(read(field.field(), slot)); };
    const glm::dvec3 d = at(penalty.pairs().slot_a[i]) - at(penalty.pairs().slot_b[i]);
    return {d.x, d.y, d.z};
  }

  static constexpr float seconds = 0.002f, damper_limit = 200;
  std::mt19937 random{5};
  LaneField x{particles}, v{particles};
  PenaltyContact penalty;
};

class PairsInLanes : public tests::OnEveryTarget {};

TEST_P(PairsInLanes, FollowTheLaw) {
  RandomPairs pairs;
  const PenaltyPairs before = pairs.penalty.pairs();
  pairs.evaluate({0, RandomPairs::count});
  int behind = 0, apart = 0, sticking = 0, sliding = 0;
  double stored = 0;
  for (std::size_t i = 0; i < RandomPairs::count; ++i) {
    using Vector = simd::Vec<double>;
    const PenaltyPair p = pair_of(before, i);
    const auto vector = [](const glm::vec3& a) { return Vector{a.x, a.y, a.z}; };
    const Vector d = pairs.way(i, pairs.x) + vector(p.offset), n = vector(p.normal);
    const PenaltyLaw<double> law{p.stiffness, pairs.penalty.layer().thickness, p.friction,
                                 double(pairs.damper_limit) * p.damped_mass};
    const auto energy = [&](const Vector& stretch) {
      const double s = dot(d, n);
      return law.stored(s, dot(d, d) - s * s) + law.stored_by_friction(dot(stretch, stretch));
    };
    Vector stretch = vector(p.stretch);
    const Vector force = law.force(d, pairs.way(i, pairs.v), n, double(pairs.seconds), stretch);
    const PenaltyPair after = pair_of(pairs.penalty.pairs(), i);
    EXPECT_NEAR(glm::distance(pairs.penalty.force({std::uint32_t(i), 0}), {force.x, force.y, force.z}), 0, 1e-5) << i;
    EXPECT_NEAR(glm::distance(glm::dvec3(after.stretch), {stretch.x, stretch.y, stretch.z}), 0, 1e-7) << i;
    EXPECT_NEAR(pairs.penalty.energy(i, pairs.x.field()), energy(stretch), 1e-7) << i;
    stored += energy(stretch);
    if (dot(force, force) == 0) {
      ++apart;
      continue;
    }
    behind += dot(d, n) < 0;
    const Vector u = pairs.way(i, pairs.v), slip = u - dot(u, n) * n,
                 moved = stretch - vector(p.stretch) - double(pairs.seconds) * slip;
    ++(std::sqrt(dot(moved, moved)) < 1e-9 ? sticking : sliding);
  }
  EXPECT_NEAR(pairs.stored_energy(1), stored, 1e-5 * stored);
  for (const int kind : {behind, apart, sticking, sliding}) EXPECT_GT(kind, 20);
}

/// In any parts.
TEST_P(PairsInLanes, GiveTheSameBits) {
  const auto results = [](const std::vector<std::size_t>& first, int threads) {
    RandomPairs pairs;
    pairs.evaluate(first);
    std::vector<float> all;
    for (const auto& component : pairs.penalty.pairs().stretch)
      all.insert(all.end(), component.begin(), component.begin() + RandomPairs::count);
    for (std::size_t i = 0; i < RandomPairs::count; ++i)
      for (int k = 0; k < 3; ++k) all.push_back(float(pairs.penalty.force({std::uint32_t(i), 0})[k]));
    return std::pair(all, pairs.stored_energy(threads));
  };
  const auto own = results({0, 7, 7, 100, 112, RandomPairs::count}, 3);
  const tests::UseTarget simplest(tests::targets().back());
  EXPECT_EQ(own, results({0, RandomPairs::count}, 1));
}

INSTANTIATE_TEST_SUITE_P(Targets, PairsInLanes, testing::ValuesIn(tests::targets()), tests::target_name);

}  // namespace THIS_FILE
}  // namespace softbody::test
