// What implicit steps are made of beside the solver: the bodies' axes, and the checks and corrections of a solve.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "softbody/integrate/implicit/planes.h"
#include "tests/softbody/implicit_rig.h"

namespace softbody::test {
namespace THIS_FILE {

/// Four particles in lane 2 that fly and spin as one, the same in lane 5, which has the world's axes.
struct Flight {
  static constexpr double h = 0.1;
  const glm::dvec3 velocity{1, -2, 3}, spin{0.5, 4, -6}, gravity{0, -9.81, 0}, fall = h * h / 2 * gravity;
  const std::vector<glm::dvec3> places{{1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {-1, -2, 0}};  // from the centre
  const glm::dvec3 centre{7, 8, 9};
  Lanes x = Lanes(3 * 4 * implicit_lanes), v = x;
  Flight() {
    for (const std::size_t lane : {2u, 5u})
      for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3 out = places[i] - middle();
        put(x, i, lane, centre + out);
        put(v, i, lane, velocity + glm::cross(spin, out));
      }
  }
  glm::dvec3 middle() const { return (places[0] + places[1] + places[2] + places[3]) / 4.0; }
  MovingAxes axes() const {
    MovingAxes made(x, v, mask({2}), h, gravity);
    made.set_fall(fall);
    return made;
  }
};

TEST(MovingAxes, TakeARigidMotionAlong) {
  constexpr double nearly = 0.01;  // how near the axes' spin comes to the body's
  const Flight f;
  const MovingAxes axes = f.axes();
  ImplicitStart start;
  axes.enter(f.x, f.v, start);
  const Lanes &x = start.x, &v = start.v;
  Lanes end_x = x, end_v = v;
  axes.leave(end_x, end_v);
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec3 out = f.places[i] - f.middle(), round = glm::cross(f.spin, out),
                     inwards = glm::cross(f.spin, round);
    EXPECT_LT(glm::distance(at(x, i, 2), out), 1e-12);
    EXPECT_LT(glm::length(at(v, i, 2)), nearly * glm::length(round));
    EXPECT_LT(glm::distance(at(start.a, i, 2), -inwards), nearly * glm::length(inwards));
    const glm::dvec3 turned = rotation(f.h * f.spin) * out, place = axes.leave(2, out);
    EXPECT_LT(glm::distance(place, turned), nearly * f.h * glm::length(round));
    EXPECT_LT(glm::distance(at(end_x, i, 2), f.centre + f.h * f.velocity + f.fall + place), 1e-12);
    EXPECT_LT(glm::distance(at(end_v, i, 2), f.velocity + f.h * f.gravity + axes.leave(2, round)), 1e-12);
    // In the axes it is so far from where it was in the world.
    EXPECT_NEAR(glm::length(at(start.carried, i, 2)), glm::distance(at(end_x, i, 2), at(f.x, i, 2)), 1e-12);
    EXPECT_EQ(at(x, i, 5), at(f.x, i, 5));
    EXPECT_EQ(at(start.a, i, 5), f.gravity);
    EXPECT_EQ(at(start.carried, i, 5), glm::dvec3(0.0));
    EXPECT_EQ(at(end_x, i, 5), at(f.x, i, 5));
  }
}

TEST(MovingAxes, TurnDirectionsAndForcesAlike) {
  const Flight f;
  const MovingAxes axes = f.axes();
  ImplicitStart start;
  axes.enter(f.x, f.v, start);
  const glm::dvec3 normal = glm::normalize(glm::dvec3(1, 2, -1));
  Lanes end_x = start.x, end_v = start.v;
  axes.leave(end_x, end_v);
  const glm::dvec3 moved = at(end_x, 3, 2) - at(f.x, 3, 2);
  EXPECT_NEAR(glm::dot(at(start.carried, 3, 2), axes.enter(2, normal)), glm::dot(moved, normal), 1e-12);
  EXPECT_LT(glm::distance(axes.leave(2, axes.enter(2, normal)), normal), 1e-12);
}

TEST(Rotation, TurnsAboutItsVectorByItsLength) {
  const glm::dvec3 axis = glm::normalize(glm::dvec3(1, -2, 2)), out = glm::cross(axis, glm::dvec3(1, 0, 0));
  for (const double angle : {0.0, 1e-8, 0.3, 2.0, 6.0}) {
    const glm::dvec3 turned = rotation(angle * axis) * out;
    EXPECT_LT(glm::distance(turned, std::cos(angle) * out + std::sin(angle) * glm::cross(axis, out)),
              1e-5 * angle * angle * angle + 1e-12);
    EXPECT_NEAR(glm::determinant(rotation(angle * axis)), 1, 1e-12);
  }
}

TEST(MovingAxes, TurnPenaltyPairs) {
  const Flight f;
  const MovingAxes axes = f.axes();
  LinearPenaltyPair pair{.at = 2, .normal = glm::normalize(glm::dvec3(1, 2, -1)), .slopes = {}, .force = {3, 5, -4}};
  pair.slopes.spring = 10, pair.slopes.damper = 2, pair.slopes.across_spring = 7, pair.slopes.across_damper = 1;
  pair.friction = 0.5, pair.partner = {0.1, 0.2, 0.3}, pair.start_separation = {-0.1, 0.2, 0.1};
  const LinearPenaltyPair turned = axes.enter(pair);
  const glm::dvec3 moved(0.2, -0.1, 0.05);
  ASSERT_GT(glm::length(pair.force_after(moved)), 1);
  EXPECT_LT(glm::distance(axes.leave(2, turned.force_after(axes.enter(2, moved))), pair.force_after(moved)), 1e-10);
}

/// Along an axis to which all is near, what swings looks like a fast spin.
TEST(MovingAxes, DoNotFollowATremor) {
  Lanes x(3 * 4 * implicit_lanes), v = x;
  const double thin = 1e-3;
  for (std::size_t i = 0; i < 4; ++i) {
    put(x, i, 0, {double(i) - 1.5, i % 2 ? thin : -thin, i < 2 ? thin : -thin});
    put(v, i, 0, glm::cross(glm::dvec3(50, 0, 2), at(x, i, 0)));
  }
  const MovingAxes axes(x, v, mask({0}), 1e-3, glm::dvec3(0.0));
  const glm::dvec3 up(0, 1, 0);  // from the centre
  EXPECT_LT(glm::distance((axes.leave(0, up) - up) / 1e-3, glm::cross(glm::dvec3(0, 0, 2), up)), 0.1);
}

/// A ball in lane 1 whose particles all move with 2 m/s.
struct Moving : ImplicitRig {
  double kinetic = 0.5 * model->material[Material::mass] * 4;  // J
  Moving() {
    move(1, {2, 0, 0});
    bodies.end_x = bodies.x, bodies.end_v = bodies.v;
  }
};

TEST(Dissipate, RemovesTheEnergyGain) {
  for (const bool pushed : {false, true}) {
    Moving m;
    EXPECT_EQ(energy_gain(*m.model, m.bodies, 1, glm::dvec3(0.0), pushed), 0);
    std::mt19937 random(1);
    glm::dvec3 momentum(0.0);
    double gain = 0;  // J
    const std::size_t n = m.model->mesh.vertices.size();
    for (std::size_t i = 0; i < n; ++i) {
      const glm::dvec3 more = random_vector(random, 1);
      put(m.bodies.v, i, 1, at(m.bodies.v, i, 1) + more);
      put(m.bodies.end_v, i, 1, at(m.bodies.end_v, i, 1) + 1.01 * more);
      momentum += at(m.bodies.end_v, i, 1);
      gain += m.model->particle_mass / 2 *
              (glm::dot(at(m.bodies.end_v, i, 1), at(m.bodies.end_v, i, 1)) -
               glm::dot(at(m.bodies.v, i, 1), at(m.bodies.v, i, 1)));
    }
    const double undue = energy_gain(*m.model, m.bodies, 1, glm::dvec3(0.0), pushed);
    EXPECT_NEAR(undue, gain, 1e-9) << "J";
    EXPECT_TRUE(dissipate(*m.model, m.bodies, 1, undue, pushed));
    EXPECT_EQ(energy_gain(*m.model, m.bodies, 1, glm::dvec3(0.0), pushed), 0);
    glm::dvec3 left(0.0);
    for (std::size_t i = 0; i < n; ++i) left += at(m.bodies.end_v, i, 1);
    if (!pushed) {
      EXPECT_LT(glm::distance(left, momentum), 1e-9);
    }
    const Lanes before = m.bodies.end_v;
    EXPECT_FALSE(dissipate(*m.model, m.bodies, 1, 2 * m.kinetic, pushed));
    EXPECT_FALSE(dissipate(*m.model, m.bodies, 1, std::numeric_limits<double>::infinity(), pushed));
    EXPECT_EQ(m.bodies.end_v, before);
  }
}

/// A plane, a penalty pair and gravity act on a ball; what lanes beside it feel has no part in it.
TEST(SatisfiesMomentumBalance, ComparesMomentumWithTheForces) {
  constexpr double h = 0.01;
  const glm::dvec3 gravity(0, -9.81, 0), by_plane(30, 200, -10), by_pair(0, 0, 150);  // N
  Moving m;
  m.bodies.planes = {plane(3, 1, {0, 1, 0}, 0, by_plane), plane(3, 2, {0, 1, 0}, 0, {1e3, 1e3, 1e3})};
  m.bodies.penalty_pairs = {penalty_pair(5, 1, {0, 0, 1}, by_pair), penalty_pair(5, 2, {0, 0, 1}, {0, 0, 1e3})};
  const glm::dvec3 given = h * (by_plane + by_pair);
  const double tenth = 0.1 * (glm::length(given) + h * m.model->material[Material::mass] * glm::length(gravity));
  const auto ends_with = [&](const glm::dvec3& momentum) {  // kg m/s, more than it started with
    for (std::size_t i = 0; i < m.model->mesh.vertices.size(); ++i)
      put(m.bodies.end_v, i, 1, at(m.bodies.v, i, 1) + momentum / m.model->material[Material::mass]);
    return satisfies_momentum_balance(*m.model, m.bodies, 1, h, gravity);
  };
  const glm::dvec3 due = given + h * m.model->material[Material::mass] * gravity;
  for (const glm::dvec3& way : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)})
    for (const double sign : {-1.0, 1.0}) {
      EXPECT_TRUE(ends_with(due + 0.99 * sign * tenth * way));
      EXPECT_FALSE(ends_with(due + 1.01 * sign * tenth * way));
    }
  EXPECT_FALSE(ends_with(glm::dvec3(std::numeric_limits<double>::quiet_NaN())));
}

/// Two planes stand in each other's way: it ends before both, at the velocity that takes it there.
TEST(ClearPlanes, LeavesNoParticleBehind) {
  constexpr double h = 0.01;
  Moving m;
  const glm::dvec3 slanting = glm::normalize(glm::dvec3(2, -1, 0));
  m.bodies.planes = {plane(3, 1, {0, 1, 0}, 0.02), plane(3, 1, slanting, 0.025), plane(4, 1, {0, 1, 0}, -0.001)};
  const Lanes before_x = m.bodies.end_x, before_v = m.bodies.end_v;
  EXPECT_TRUE(behind_planes(m.bodies)[1]);
  EXPECT_FALSE(behind_planes(m.bodies)[2]);
  clear_planes(m.bodies, mask({1}), h);
  const glm::dvec3 moved = at(m.bodies.end_x, 3, 1) - at(before_x, 3, 1);
  EXPECT_NEAR(moved.y, 0.02, 1e-6) << "m: no farther than it needs";
  EXPECT_NEAR(glm::dot(moved, slanting), 0.025, 1e-6) << "m";
  EXPECT_LT(glm::distance(at(m.bodies.end_v, 3, 1) - at(before_v, 3, 1), moved / h), 1e-9);
  EXPECT_EQ(at(m.bodies.end_x, 4, 1), at(before_x, 4, 1));
}

}  // namespace THIS_FILE
}  // namespace softbody::test
