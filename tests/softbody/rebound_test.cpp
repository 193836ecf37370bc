// Restitution: what an impact gives back when its sides part.

#include "softbody/contact/rebound.h"

#include <gtest/gtest.h>

#include <cmath>

#include "softbody/contact/law.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

constexpr double mass = 2, dt = 0.015;

/// A frame of a body that comes down on something and is thrown up: in m/s its velocity at the end, what contact has
/// added to that, and what is due; in J what restitution gives back later.
struct Frame {
  double velocity, gained, returned, due;
};

struct Course {
  const char* name;
  std::vector<Frame> frames;
  bool over;  // at the end
};

TEST(Rebound, GivesTheEnergyBackWhenTheSidesPart) {
  const double slow = 0.99 * law::impact_speed;
  const Frame comes{-3.2, 0, 0, 0};
  const Course courses[]{
      {"takes nothing", {{-3, 3, 0, 0}, {2, 5, 0, 0}, {2, 0, 0, 0}, {2, 0, 0, 0}}, true},
      {"1 J", {{-3, 3, 0.5, 0}, {2, 5, 0.5, 0}, {2, 0, 0, 0}, {2, 0, 0, std::sqrt(5.0) - 2}}, true},
      {"9 J", {{-3, 3, 4.5, 0}, {2, 5, 4.5, 0}, {2, 0, 0, 0}, {2, 0, 0, std::sqrt(13.0) - 2}}, true},
      {"no faster than it came", {{-3, 3, 500, 0}, {2, 5, 500, 0}, {2, 0, 0, 0}, {2, 0, 0, 4}}, true},
      {"what springs gave stays", {{-3, 3, 500, 0}, {7, 10, 500, 0}, {7, 0, 0, 0}, {7, 0, 0, 0}}, true},
      {"nothing of a slow impact", {{0, slow, 1, 0}, {0.1, 0, 0, 0}}, true},
      {"gravity turns it round", {{0.28, 1.28, 4, 0}, {0.1, 0, 0, 0}, {-0.1, 0, 0, 1.1}}, true},
      {"contact comes and goes",
       {{0.5, 4.5, 4, 0}, {0.5, 0, 0, 0}, {1, 0.5, 0, 0}, {1, 0, 0, 0}, {1.5, 0.5, 0, 0}, {1.5, 0, 0, 0}},
       false},
      {"stopped flat, it does not leave", {{-2, 2, 4.5, 0}, {0, 2, 4.5, 0}, {0, 0, 0, 0}, {0, 0, 0, 3}}, true},
      {"past a ledge that its end hit", {{-3, 1, 5, 0}, comes, comes, comes, comes, comes}, true},
      {"past it, and onto what gives nothing",
       {{-3, 1, 5, 0}, comes, comes, comes, comes, comes, {0, 4, 0, 0}, {1, 0, 0, 0}},
       false},
      {"contact gave 1 J of 4", {{0, 6, 4, 0}, {1, 1, -1, 0}, {1, 0, 0, 0}, {1, 0, 0, 1}}, true},
      {"contact gave more than it took", {{0, 6, 4, 0}, {1, 1, -5, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}}, true},
  };
  for (const Course& course : courses) {
    SCOPED_TRACE(course.name);
    Impact impact;
    for (const auto& [velocity, gained, returned, due] : course.frames) {
      const glm::dvec3 change =
          rebound(impact, {0, mass * gained, 0}, returned, {0, velocity - gained, 0}, {0, velocity, 0}, mass, dt);
      EXPECT_NEAR(change.y, due, 1e-12) << "after " << velocity << " m/s";
      EXPECT_NEAR(impact.given, mass / 2 * due * (2 * velocity + due), 1e-5) << "J, after " << velocity << " m/s";
    }
    EXPECT_EQ(impact.speed <= 0, course.over);
  }
}

/// In short frames its speed hardly changes from one to the next, at 200 m/s^2.
TEST(Rebound, WaitsForTheEndOfContactInShortFrames) {
  Impact impact;
  for (double v = -4; v < 3; v += 0.02)
    EXPECT_EQ(rebound(impact, {0, 0.02 * mass, 0}, 0.01, {0, v - 0.02, 0}, {0, v, 0}, mass, 1e-4), glm::dvec3(0.0));
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
