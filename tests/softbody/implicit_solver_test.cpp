// What the implicit solver is made of: the minimiser, and the search for the forces of solids.

#include "softbody/integrate/implicit/quasi_newton.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/softbody/implicit_rig.h"

namespace softbody::test {
namespace THIS_FILE {

/// In each lane, sum c_i / 2 (x_i - 1)^2 + q / 4 (x_i - 1)^4, with coefficients c_i from `softest` to `stiffest` and q
/// of the lane. Its second derivative is taken to be 1.
struct Bowls {
  static constexpr std::size_t particles = 20;
  double softest = 1, stiffest = 4;
  std::array<double, implicit_lanes> quartic{};
  Lanes x = Lanes(3 * particles * implicit_lanes);
  int gradients = 0;
  Minimiser minimiser{particles};

  bool run(int iterations, double max_step = 1e3) {
    const auto gradient = [&](const Lanes& at, Lanes& g) {
      ++gradients;
      for (std::size_t i = 0; i < at.size(); ++i) {
        const double d = at[i] - 1,
                     c = softest + (stiffest - softest) * double(i / implicit_lanes) / double(3 * particles);
        g[i] = c * d + quartic[i % implicit_lanes] * d * d * d;
      }
    };
    PerLane max;
    max.fill(max_step);
    return minimiser.minimise({gradient, [](Lanes&) {}}, x, max, 1e-10, iterations);
  }
  double error(std::size_t lane) const {
    double most = 0;
    for (std::size_t i = lane; i < x.size(); i += implicit_lanes) most = std::max(most, std::abs(x[i] - 1));
    return most;
  }
};

TEST(Minimiser, FindsTheMinimumOfEachLane) {
  Bowls bowls;
  for (std::size_t lane = 0; lane < implicit_lanes; ++lane) bowls.quartic[lane] = double(lane * lane);
  EXPECT_TRUE(bowls.run(60));
  EXPECT_TRUE(bowls.minimiser.converged().all());
  for (std::size_t lane = 0; lane < implicit_lanes; ++lane) EXPECT_LT(bowls.error(lane), 1e-9) << lane;
  EXPECT_EQ(std::fmod(bowls.minimiser.take_work(), double(Bowls::particles)), 0);
  EXPECT_EQ(bowls.minimiser.take_work(), 0);
}

TEST(Minimiser, IsDoneAtOnceWhereTheMatrixIsExact) {
  Bowls bowls;
  bowls.stiffest = 1;
  EXPECT_TRUE(bowls.run(2)) << "one step, and one that says that it is there";
  EXPECT_EQ(bowls.minimiser.take_work(), 2 * Bowls::particles);
}

/// What it has learnt before makes the next search shorter.
TEST(Minimiser, RemembersTheCurvatureUntilItForgets) {
  const auto gradients = [](bool forget) {
    Bowls bowls;
    bowls.softest = 4;
    EXPECT_TRUE(bowls.run(60));
    if (forget) bowls.minimiser.forget();
    std::fill(bowls.x.begin(), bowls.x.end(), 0.0);
    bowls.gradients = 0;
    EXPECT_TRUE(bowls.run(60));
    return bowls.gradients;
  };
  EXPECT_LT(gradients(false), gradients(true));
}

TEST(Minimiser, TakesNoStepLongerThanItMay) {
  Bowls bowls;
  bowls.stiffest = 1;
  EXPECT_FALSE(bowls.run(1, 0.25));
  double square = 0;
  for (std::size_t i = 3; i < bowls.x.size(); i += implicit_lanes) square += bowls.x[i] * bowls.x[i];
  EXPECT_NEAR(std::sqrt(square / Bowls::particles), 0.25, 1e-12);
}

TEST(Minimiser, StaysWhereALaneIsLost) {
  Bowls bowls;
  bowls.quartic[2] = std::numeric_limits<double>::quiet_NaN();
  bowls.run(60);
  EXPECT_EQ(bowls.minimiser.converged()[2], true) << "it does not move";
  EXPECT_EQ(bowls.error(2), 1) << "it is where it was";
  EXPECT_LT(bowls.error(1), 1e-9);
}

/// A ball in lane 0 that has been moved by `by`, with a plane that asks for `min_displacement` at its particle 3.
struct Pressed : ImplicitRig {
  explicit Pressed(double min_displacement, const glm::dvec3& by = glm::dvec3(0.0)) {
    matrices.prepare(*model, h);
    bodies.planes = {plane(3, 0, {0, 1, 0}, min_displacement)};
    for (std::size_t i = 0; i < particles(); ++i) put(bodies.end_x, i, 0, at(bodies.x, i, 0) + by);
  }
  ImplicitProblem problem() {
    const Lanes none(bodies.x.size());
    local = {bodies.x, bodies.v, none, none};
    return {*model, matrices.at(h), h, local, h, bodies.planes};
  }
  /// m, how far the particle moves under its contact's force.
  glm::dvec3 response() { return matrices.at(h).compliance(3, 3) * bodies.planes[0].force; }
  double update() {
    changes.assign(bodies.x.size(), 0.0);
    return contact.update(problem(), bodies.planes, bodies.end_x, glm::dmat3(1.0), changes);
  }
  ContactForces contact;
  Lanes changes;
};

TEST(ContactForces, AreAsLargeAsThePlaneAsksFor) {
  Pressed p(0.01, {0, 0.004, 0});
  p.contact.start(false);
  const double most = p.update();
  EXPECT_NEAR(most, glm::length(p.response()), 1e-9) << "m";
  EXPECT_NEAR(p.response().y, 0.01 - 0.004, 1e-9);
  EXPECT_EQ(at(p.changes, 3, 0), p.bodies.planes[0].force);
  EXPECT_GT(p.contact.take_work(), 0);
  EXPECT_EQ(p.contact.take_work(), 0);
}

TEST(ContactForces, NeverPull) {
  Pressed p(-10);
  p.bodies.planes[0].force = {0, 100, 0};
  p.contact.start(false);
  p.update();
  EXPECT_EQ(p.bodies.planes[0].force, glm::dvec3(0.0));
  EXPECT_EQ(at(p.changes, 3, 0), glm::dvec3(0, -100, 0));
}

TEST(ContactForces, StickOrSlideByCoulombsLaw) {
  for (const double friction : {0.2, 100.0}) {
    Pressed p(0.01, {0.005, 0, 0});
    p.bodies.planes[0].friction = friction;
    p.contact.start(false);
    p.update();
    const glm::dvec3 force = p.bodies.planes[0].force;
    if (friction < 1) {
      EXPECT_NEAR(std::hypot(force.x, force.z), friction * force.y, 1e-6 * force.y);
    } else {
      EXPECT_NEAR(p.response().x, -0.005, 1e-6) << "m: it comes back to where it was";
    }
    EXPECT_LT(force.x, 0);
  }
}

TEST(ContactForces, CorrectWhatIsLeftBySprings) {
  Pressed p(0.01);
  p.bodies.planes[0].force = {0, 3, 0};
  p.bodies.planes[0].friction = 0.5;
  const double k = p.matrices.at(p.h).contact_stiffness();
  const glm::dvec3 moved(1, 0.002, 0);
  p.contact.start(false);
  EXPECT_EQ(p.contact.force(p.problem(), p.bodies.planes[0], moved), p.bodies.planes[0].force);
  p.contact.start(true);
  const glm::dvec3 force = p.contact.force(p.problem(), p.bodies.planes[0], moved);
  EXPECT_NEAR(force.y, 3 + k * 0.008, 1e-9 * k);
  EXPECT_NEAR(force.x, -0.5 * force.y, 1e-9 * k);
  EXPECT_EQ(p.contact.force(p.problem(), p.bodies.planes[0], {0, 1e3, 0}), glm::dvec3(0.0));
}

/// Planes that face each other ask for what no forces give.
TEST(ContactForces, AreNotFoundWherePlanesContradictEachOther) {
  Pressed p(0.1);
  p.bodies.planes.push_back(plane(3, 0, {0, -1, 0}, 0.1));
  p.contact.start(false);
  EXPECT_EQ(p.update(), std::numeric_limits<double>::infinity());
  for (const PlaneContact& c : p.bodies.planes) EXPECT_EQ(c.force, glm::dvec3(0.0));
  EXPECT_EQ(p.changes, Lanes(p.changes.size()));
}

}  // namespace THIS_FILE
}  // namespace softbody::test
