// The attempts at an implicit step, each by itself, and their order.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "collide/surface/surface.h"
#include "softbody/integrate/implicit/planes.h"
#include "tests/softbody/implicit_rig.h"

namespace softbody::test {
namespace THIS_FILE {

/// Makes the end of all lanes something that no attempt comes to, makes an attempt in the lanes `tried`, and expects it
/// to leave the other lanes alone. Returns what it has solved.
LaneMask attempt(LaneMask (*advance)(ImplicitStep&, ImplicitBodies&, LaneMask), ImplicitRig& rig, LaneMask tried,
                 LaneMask in_contact = {}) {
  constexpr double untouched = 12345;
  for (Lanes* end : {&rig.bodies.end_x, &rig.bodies.end_v}) end->assign(end->size(), untouched);
  std::vector<glm::dvec3> forces;
  for (const PlaneContact& c : rig.bodies.planes) forces.push_back(c.force);
  ImplicitStep step = rig.step(LaneMask().set(), in_contact);
  const LaneMask solved = advance(step, rig.bodies, tried);
  EXPECT_EQ(solved & ~tried, LaneMask()) << "solves only what it is asked for";
  for (std::size_t i = 0; i < rig.bodies.end_x.size(); ++i)
    if (!tried[i % implicit_lanes]) {
      EXPECT_EQ(rig.bodies.end_x[i], untouched);
      EXPECT_EQ(rig.bodies.end_v[i], untouched);
    }
  for (std::size_t i = 0; i < forces.size(); ++i)
    if (!tried[rig.bodies.planes[i].point.lane()]) {
      EXPECT_EQ(rig.bodies.planes[i].force, forces[i]);
    }
  return solved;
}

/// N s, what a lane's planes give.
glm::dvec3 impulse(const ImplicitRig& rig, std::size_t lane) {
  glm::dvec3 sum(0.0);
  for (const PlaneContact& c : rig.bodies.planes)
    if (c.point.lane() == lane) sum += rig.h * c.force;
  return sum;
}

TEST(SecondOrderStep, FallsAndSpinsByTheClosedForm) {
  ImplicitRig rig(1e6);
  rig.gravity = {0, -9.81, 0};
  const glm::dvec3 velocity(1, 2, -3), spin(2, -1, 0.5);
  rig.move(3, velocity, spin);
  ASSERT_EQ(attempt(second_order_step, rig, mask({3})), mask({3}));
  const RigidMotion start = rig.start(3), end = rig.end(3);
  EXPECT_LT(glm::distance(end.centre - start.centre, rig.h * velocity + rig.h * rig.h / 2 * rig.gravity), 1e-12);
  EXPECT_LT(glm::distance(end.velocity, velocity + rig.h * rig.gravity), 1e-12);
  EXPECT_LT(glm::distance(end.momentum, start.momentum), 1e-12 * glm::length(start.momentum));
  const glm::dvec3 turned = rotation(rig.h * spin) * at(rig.bodies.x, 7, 3);
  EXPECT_LT(glm::distance(at(rig.bodies.end_x, 7, 3) - end.centre, turned), 1e-5) << "m; it begins to swell";
}

/// The error of one step falls with the third power of its length.
TEST(SecondOrderStep, IsOfSecondOrder) {
  const auto end = [](double h, int steps) {
    ImplicitRig rig(1e3, h / steps);
    rig.move(0, {0.5, 0, 0}, {0, 1, 0}, {1.02, 0.99, 0.99});
    for (int s = 0; s < steps; ++s) {
      EXPECT_EQ(attempt(second_order_step, rig, mask({0})), mask({0}));
      rig.bodies.x = rig.bodies.end_x, rig.bodies.v = rig.bodies.end_v;
    }
    return rig.bodies.x;
  };
  const auto error = [&](double h) {
    const Lanes once = end(h, 1), truth = end(h, 32);
    double square = 0;
    for (std::size_t i = 0; i < once.size(); i += implicit_lanes) square += (once[i] - truth[i]) * (once[i] - truth[i]);
    return std::sqrt(square);
  };
  const double ratio = error(2e-3) / error(1e-3);
  EXPECT_GT(ratio, 7);
  EXPECT_LT(ratio, 9);
}

TEST(SecondOrderStep, RefusesBodiesInContact) {
  ImplicitRig rig;
  EXPECT_EQ(attempt(second_order_step, rig, mask({1, 4}), mask({4, 5})), mask({1}));
  EXPECT_EQ(attempt(second_order_step, rig, mask({4}), mask({4, 5})), LaneMask());
}

/// A plane that free flight would not meet, but that the body's swing does.
TEST(SecondOrderStep, RefusesWhatEndsBehindAPlane) {
  ImplicitRig rig(1e4);
  for (const std::size_t lane : {1u, 2u}) rig.move(lane, glm::dvec3(0.0), glm::dvec3(0.0), {1.05, 0.98, 0.98});
  rig.add_plane(1, {0, 1, 0}, 1e-4);
  EXPECT_EQ(attempt(second_order_step, rig, mask({1, 2})), mask({2}));
}

/// A slack body without dampers, which its spin draws out far.
TEST(SecondOrderStep, RefusesAGainOfEnergy) {
  ImplicitRig rig(100, 0.01, 0);
  rig.move(5, glm::dvec3(0.0), {0, 30, 0}, {0.9, 1, 1});
  EXPECT_EQ(attempt(second_order_step, rig, mask({4, 5})), mask({4}));
  EXPECT_TRUE(rig.solver.converged()[5]);
  EXPECT_GT(rig.gain(5, false), 0.1) << "J";
}

TEST(SecondOrderStep, RefusesWhatDoesNotConverge) {
  ImplicitRig rig(100, 0.05);
  rig.move(5, glm::dvec3(0.0), glm::dvec3(0.0), {1.2, 1, 1});
  for (std::size_t i = 0; i < rig.particles(); ++i)
    put(rig.bodies.v, i, 5, glm::dvec3(30, -30, 0) * at(rig.bodies.x, i, 5));
  EXPECT_EQ(attempt(second_order_step, rig, mask({4, 5})), mask({4}));
  EXPECT_FALSE(rig.solver.converged()[5]);
}

TEST(FirstOrderStep, FallsByTheClosedFormOfBackwardEuler) {
  ImplicitRig rig;
  rig.gravity = {0, -9.81, 0};
  const glm::dvec3 velocity(1, 2, -3);
  rig.move(3, velocity, {0, 2, 0});
  ASSERT_EQ(attempt(first_order_step, rig, mask({3})), mask({3}));
  EXPECT_LT(glm::distance(rig.end(3).centre - rig.start(3).centre, rig.h * (velocity + rig.h * rig.gravity)), 1e-12);
  EXPECT_LT(glm::distance(rig.end(3).velocity, velocity + rig.h * rig.gravity), 1e-12);
  EXPECT_LT(glm::distance(rig.end(3).momentum, rig.start(3).momentum), 1e-12 * glm::length(rig.start(3).momentum));
}

/// What solids push a body with is what its momentum changes by.
TEST(FirstOrderStep, StopsAtPlanes) {
  ImplicitRig rig(1e5);
  rig.gravity = {0, -9.81, 0};
  rig.move(1, {0.5, -2, 0});
  rig.move(6, {0.5, -2, 0});
  for (const std::size_t lane : {1u, 6u}) rig.add_plane(lane, {0, 1, 0}, 0.001);
  ASSERT_EQ(attempt(first_order_step, rig, mask({1})), mask({1}));
  EXPECT_EQ(behind_planes(rig.bodies) & mask({1}), LaneMask());
  const glm::dvec3 given = impulse(rig, 1);
  EXPECT_GT(given.y, 0.1) << "N s";
  EXPECT_LT(std::hypot(given.x, given.z), 1e-6 * given.y) << "the planes are smooth";
  const glm::dvec3 gained =
      rig.model->material[Material::mass] * (rig.end(1).velocity - rig.start(1).velocity - rig.h * rig.gravity);
  EXPECT_LT(glm::distance(gained, given), 1e-4 * given.y) << gained.y << " " << given.y;
  EXPECT_EQ(rig.gain(1, true), 0);
}

/// A point of a face, whose corners share the force by their weights.
TEST(FirstOrderStep, KeepsAPointOfAFaceInFrontOfItsPlane) {
  ImplicitRig rig(1e5);
  const auto face = rig.model->surface->triangles()[0];
  PlaneContact c = plane(0, 1, glm::normalize(glm::dvec3(1, 2, -1)), 1e-3);
  c.point.weight = {0.5, 0.3, 0.2};
  for (std::size_t k = 0; k < 3; ++k) c.point.at[k] = face[k] * implicit_lanes + 1;
  rig.bodies.planes = {c};
  ASSERT_EQ(attempt(first_order_step, rig, mask({1})), mask({1}));
  const glm::dvec3 moved =
      c.point.mean([&](std::size_t at) { return read(rig.bodies.end_x, at) - read(rig.bodies.x, at); });
  EXPECT_NEAR(glm::dot(moved, c.normal), c.min_displacement, 1e-7);
  const glm::dvec3 gained = rig.model->material[Material::mass] * rig.end(1).velocity, given = impulse(rig, 1);
  EXPECT_GT(glm::dot(given, c.normal), 1e-3) << "N s";
  EXPECT_LT(glm::distance(gained, given), 1e-4 * glm::length(given));
  const glm::dvec3 lever = c.point.mean([&](std::size_t at) { return read(rig.bodies.end_x, at); }) - rig.end(1).centre;
  EXPECT_LT(glm::distance(rig.model->particle_mass * rig.end(1).momentum, glm::cross(lever, given)),
            1e-2 * glm::length(given));
}

/// Coulomb's law: a body that slides is slowed by the coefficient times the normal force.
TEST(FirstOrderStep, SlowsWhatSlides) {
  ImplicitRig rig(1e5);
  rig.gravity = {0, -9.81, 0};
  rig.move(1, {2, 0, 0});
  rig.add_plane(1, {0, 1, 0}, 0);
  for (PlaneContact& c : rig.bodies.planes) c.friction = 0.3;
  ASSERT_EQ(attempt(first_order_step, rig, mask({1})), mask({1}));
  const glm::dvec3 given = impulse(rig, 1);
  EXPECT_GT(given.y, 0);
  EXPECT_NEAR(given.x, -0.3 * given.y, 1e-6 * given.y);
}

TEST(FirstOrderStep, TakesTheMomentumThatPenaltyPairsGive) {
  ImplicitRig rig;
  const glm::dvec3 force(0, 30, -5);  // N
  rig.bodies.penalty_pairs = {penalty_pair(5, 1, glm::normalize(force), force),
                              penalty_pair(5, 2, glm::normalize(force), -force)};
  for (LinearPenaltyPair& s : rig.bodies.penalty_pairs) s.max_work = 1;
  ASSERT_EQ(attempt(first_order_step, rig, mask({1})), mask({1}));
  EXPECT_LT(glm::distance(rig.model->material[Material::mass] * rig.end(1).velocity, rig.h * force), 1e-12);
  const glm::dvec3 lever = at(rig.bodies.end_x, 5, 1) - rig.end(1).centre;
  EXPECT_LT(glm::distance(rig.model->particle_mass * rig.end(1).momentum, rig.h * glm::cross(lever, force)), 1e-12);
}

/// Two walls that leave a body a tenth of its width.
void crush(ImplicitRig& rig, std::size_t lane) {
  for (const double side : {1.0, -1.0}) rig.add_plane(lane, {side, 0, 0}, -0.45);
}

TEST(FirstOrderStep, RefusesWhatItsForcesDoNotExplain) {
  ImplicitRig rig(1e6);
  rig.move(2, {0, -1, 0});
  crush(rig, 2);
  EXPECT_EQ(attempt(first_order_step, rig, mask({2, 3})), mask({3}));
}

/// Planes stop the body in lane 1, the one in lane 3 falls, and no step is taken in lane 2.
TEST(RigidFallbackStep, KeepsTheSpinOfABodyThatFallsOrIsStopped) {
  ImplicitRig rig;
  const glm::dvec3 velocity(2, -1, 0), spin(0, 3, 0);
  rig.gravity = {0, -9.81, 0};
  for (const std::size_t lane : {1u, 2u, 3u}) {
    rig.move(lane, velocity, spin);
    if (lane == 3) continue;
    for (std::size_t i = 0; i < rig.particles(); ++i)
      rig.bodies.planes.push_back(plane(i, lane, {0, 1, 0}, 0, {1, 1, 1}));
  }
  ASSERT_EQ(attempt(rigid_fallback_step, rig, mask({1, 3})), mask({1, 3}));
  EXPECT_LT(glm::distance(rig.end(1).velocity, glm::dvec3(2, 0, 0)), 1e-9);
  EXPECT_LT(glm::distance(rig.end(3).velocity, velocity + rig.h * rig.gravity), 1e-9);
  for (const std::size_t lane : {1u, 3u}) EXPECT_LT(glm::distance(rig.end(lane).spin, spin), 0.01);
  EXPECT_EQ(impulse(rig, 1), glm::dvec3(0.0));
  EXPECT_NE(impulse(rig, 2), glm::dvec3(0.0));
}

/// Its shape stays, and what its particles did beside the rigid motion is lost.
TEST(RigidFallbackStep, MovesABodyAsItIsWithoutAGainOfEnergy) {
  ImplicitRig rig;
  std::mt19937 random(4);
  rig.move(1, {0, -1, 0}, {20, 1, 2}, {0.2, 1, 3});
  for (std::size_t i = 0; i < rig.particles(); ++i)
    write(rig.bodies.v, i * implicit_lanes + 1, at(rig.bodies.v, i, 1) + random_vector(random, 1));
  ASSERT_EQ(attempt(rigid_fallback_step, rig, mask({1})), mask({1}));
  double before = 0, after = 0;
  for (std::size_t i = 0; i < rig.particles(); ++i) {
    before += glm::dot(at(rig.bodies.v, i, 1), at(rig.bodies.v, i, 1));
    after += glm::dot(at(rig.bodies.end_v, i, 1), at(rig.bodies.end_v, i, 1));
    EXPECT_NEAR(glm::distance(at(rig.bodies.end_x, i, 1), at(rig.bodies.end_x, 0, 1)),
                glm::distance(at(rig.bodies.x, i, 1), at(rig.bodies.x, 0, 1)), 1e-12);
  }
  EXPECT_LE(after, before * (1 + 1e-9));
  EXPECT_LT(glm::distance(rig.end(1).velocity, rig.start(1).velocity), 1e-12);
}

/// Each lane is solved by the first attempt that is for it, and all are solved in the end.
TEST(ImplicitAttempts, GoFromTheMostAccurateToTheOneThatAlwaysWorks) {
  ImplicitRig rig(1e6);
  rig.move(1, {0, -2, 0});
  rig.add_plane(1, {0, 1, 0}, 0.001);
  rig.move(2, {0, -1, 0});
  crush(rig, 2);
  LaneMask open = mask({0, 1, 2});
  const LaneMask solved_by[] = {mask({0}), mask({1}), mask({2})};
  ASSERT_EQ(implicit_attempts.size(), std::size(solved_by));
  for (std::size_t i = 0; i < implicit_attempts.size(); ++i) {
    EXPECT_EQ(attempt(implicit_attempts[i], rig, open, mask({1, 2})), solved_by[i]) << i;
    open &= ~solved_by[i];
  }
  EXPECT_EQ(open, LaneMask());
}

}  // namespace THIS_FILE
}  // namespace softbody::test
