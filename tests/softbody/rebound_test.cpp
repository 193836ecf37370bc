// Restitution: what an impact gives back when its sides part.

#include "softbody/contact/rebound.h"

#include <gtest/gtest.h>

#include <cmath>

#include "softbody/contact/law.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

constexpr double mass = 2, dt = 0.015;

/// A body that comes down at `speed` and is stopped and thrown up by the contact, in three frames.
struct Bounce {
  Impact impact;
  double out;
  Bounce(double speed, double returned, double parting = 2) : out(parting) {
    EXPECT_EQ(frame(-speed / 2, speed / 2, returned / 2), 0) << "it still comes";
    EXPECT_EQ(frame(parting, speed / 2 + parting, returned / 2), 0) << "its speed grows";
    for (int i = 0; i < 2; ++i) out += frame(parting, 0, 0);
  }
  double frame(double velocity, double gained, double returned) {
    return rebound(impact, {0, mass * gained, 0}, returned, {0, velocity - gained, 0}, {0, velocity, 0}, mass, dt).y;
  }
};

TEST(Rebound, GivesTheEnergyBackWhenTheSidesPart) {
  for (const double returned : {0.0, 1.0, 9.0}) {
    const Bounce bounce(6, returned);
    EXPECT_NEAR(mass / 2 * bounce.out * bounce.out, mass / 2 * 4 + returned, 1e-12);
    EXPECT_NEAR(bounce.impact.given, returned, 1e-12);
    EXPECT_EQ(bounce.impact.speed, 0) << "it is over";
  }
}

TEST(Rebound, LeavesNoFasterThanItCame) {
  EXPECT_NEAR(Bounce(6, 1e3).out, 6, 1e-12);
  EXPECT_NEAR(Bounce(6, 1e3, 7).out, 7, 1e-12) << "but keeps what the springs gave";
}

TEST(Rebound, GivesNothingBackOfSlowImpacts) {
  Impact impact;
  const double speed = 0.99 * law::impact_speed;
  EXPECT_EQ(rebound(impact, {0, mass * speed, 0}, 1, {0, -speed, 0}, glm::dvec3(0.0), mass, dt), glm::dvec3(0.0));
  EXPECT_EQ(rebound(impact, glm::dvec3(0.0), 0, glm::dvec3(0.0), {0, 0.1, 0}, mass, dt), glm::dvec3(0.0));
}

/// It has left slowly, and falls again.
TEST(Rebound, GivesTheEnergyBackThoughGravityTurnsTheBodyRound) {
  Impact impact;
  rebound(impact, {0, 1.28 * mass, 0}, 4, {0, -1, 0}, {0, 0.28, 0}, mass, dt);
  EXPECT_EQ(rebound(impact, glm::dvec3(0.0), 0, {0, 0.1, 0}, {0, 0.1, 0}, mass, dt), glm::dvec3(0.0));
  const glm::dvec3 change = rebound(impact, glm::dvec3(0.0), 0, {0, -0.1, 0}, {0, -0.1, 0}, mass, dt);
  EXPECT_NEAR(change.y, 1 + 0.1, 1e-12) << "as fast as it came";
}

TEST(Rebound, WaitsForContactThatComesAndGoes) {
  Impact impact;
  rebound(impact, {0, 4.5 * mass, 0}, 4, {0, -4, 0}, {0, 0.5, 0}, mass, dt);
  for (double speed = 0.5; speed < 2; speed += 0.5) {
    EXPECT_EQ(rebound(impact, glm::dvec3(0.0), 0, {0, speed, 0}, {0, speed, 0}, mass, dt), glm::dvec3(0.0));
    EXPECT_EQ(rebound(impact, {0, 0.5 * mass, 0}, 0, {0, speed, 0}, {0, speed + 0.5, 0}, mass, dt), glm::dvec3(0.0));
  }
}

/// In short frames its speed hardly changes from one to the next, at 200 m/s^2.
TEST(Rebound, WaitsForTheEndOfContactInShortFrames) {
  Impact impact;
  for (double v = -4; v < 3; v += 0.02)
    EXPECT_EQ(rebound(impact, {0, 0.02 * mass, 0}, 0.01, {0, v - 0.02, 0}, {0, v, 0}, mass, 1e-4), glm::dvec3(0.0));
}

/// It does so though it does not leave what it lies on.
TEST(Rebound, ThrowsBackWhatIsStoppedFlat) {
  Bounce flat(4, 9, 0);
  EXPECT_NEAR(flat.out, 3, 1e-12);
}

/// Its end hit a ledge; the solid that it falls on gives nothing.
TEST(Rebound, IsOverWhenContactEndsThoughTheBodyStillComes) {
  Impact impact;
  rebound(impact, {0, mass, 0}, 5, {0, -4, 0}, {0, -3, 0}, mass, dt);
  for (double gap = 0; gap <= 0.06; gap += dt)
    EXPECT_EQ(rebound(impact, glm::dvec3(0.0), 0, {0, -3.2, 0}, {0, -3.2, 0}, mass, dt), glm::dvec3(0.0));
  EXPECT_EQ(impact.speed, 0);
  rebound(impact, {0, 4 * mass, 0}, 0, {0, -4, 0}, glm::dvec3(0.0), mass, dt);
  EXPECT_EQ(rebound(impact, glm::dvec3(0.0), 0, {0, 1, 0}, {0, 1, 0}, mass, dt), glm::dvec3(0.0));
}

TEST(Rebound, TakesBackWhatContactGave) {
  const auto out = [](double gave) {
    Impact impact;
    rebound(impact, {0, 6 * mass, 0}, 4, {0, -6, 0}, glm::dvec3(0.0), mass, dt);
    rebound(impact, {0, mass, 0}, -gave, glm::dvec3(0.0), {0, 1, 0}, mass, dt);
    rebound(impact, glm::dvec3(0.0), 0, {0, 1, 0}, {0, 1, 0}, mass, dt);
    const glm::dvec3 change = rebound(impact, glm::dvec3(0.0), 0, {0, 1, 0}, {0, 1, 0}, mass, dt);
    EXPECT_EQ(impact.speed, 0) << "it is over";
    return change;
  };
  EXPECT_NEAR(out(1).y, std::sqrt(1 + 2 * (4 - 1) / mass) - 1, 1e-12);
  EXPECT_EQ(out(5), glm::dvec3(0.0)) << "more than it took";
}

TEST(Rebound, GoesAlongTheNormalsOfTheImpact) {
  Impact impact;
  rebound(impact, mass * glm::dvec3(3, 4, 0), 4, {-3, -4, 1}, {0, 0, 1}, mass, dt);
  rebound(impact, glm::dvec3(0.0), 0, {0, 0, 1}, {0, 0, 1}, mass, dt);
  const glm::dvec3 change = rebound(impact, glm::dvec3(0.0), 0, {0, 0, 1}, {0, 0, 1}, mass, dt);
  EXPECT_NEAR(glm::distance(change, 2.0 * glm::dvec3(0.6, 0.8, 0)), 0, 1e-12);
}

/// Two balls of unlike masses that come together along x.
TEST(Rebounds, GiveBothBodiesOppositeImpulses) {
  State state;
  Material heavy = spring_ball();
  heavy[Material::mass] = 3;
  state.add(make_unbalanced_body_model({}, spring_ball()), {-1, 0, 0}, {0.5, 1, 0});
  state.add(make_unbalanced_body_model({}, heavy), {1, 0, 0}, {0.5, 0, 2});
  Rebounds rebounds;
  const auto frame = [&](double impulse, double returned) {
    if (impulse > 0) rebounds.add({0, 1, {-impulse, 0, 0}, returned});
    return rebounds.give_back(state, dt);
  };
  const auto of = [&](BodyId id) { return state.particle(id, 7).velocity; };
  const double m = state.model(0).material[Material::mass], reduced = 3 * m / (3 + m), energy = 2;
  EXPECT_EQ(frame(4 * reduced, energy), 0) << "stopped, for now";
  EXPECT_EQ(frame(0, 0), 0) << "contact may go on";
  EXPECT_NEAR(frame(0, 0), energy, 1e-6);
  EXPECT_NEAR(m * (of(0).x - 0.5) + 3 * (of(1).x - 0.5), 0, 1e-6);
  EXPECT_NEAR(of(1).x - of(0).x, std::sqrt(2 * energy / reduced), 1e-5);
  EXPECT_EQ(of(0).y, 1);
  EXPECT_EQ(of(1).z, 2);
  EXPECT_EQ(frame(0, 0), 0) << "once";
  frame(4 * reduced, energy), frame(0, 0);
  rebounds.remove(0);
  EXPECT_EQ(frame(0, 0), 0) << "forgotten with the body";
}

}  // namespace THIS_FILE
}  // namespace softbody::test
