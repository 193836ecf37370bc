// The spring kernel of every instruction set against closed forms, each lane on its own.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "softbody/mechanics/kernels.h"
#include "softbody/state/kernels.h"
#include "tests/every_target.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

/// Hooke and damper along the spring, as the paper has them: the force on i.
glm::dvec3 pull(const LaneField& x, const LaneField& v, const SpringOf<float>& s, int lane) {
  const glm::dvec3 dx = x.at(s.j, lane) - x.at(s.i, lane);
  const glm::dvec3 dv = v.at(s.j, lane) - v.at(s.i, lane);
  const double length = glm::length(dx);
  return (double(s.stiffness) * (length - s.rest) + double(s.damping) * glm::dot(dv, dx) / length) * dx / length;
}

/// Particles that springs join.
BodyModel model_of(std::size_t particles, const std::vector<SpringOf<float>>& springs) {
  BodyModel model;
  model.mesh.vertices.resize(particles);
  return with_force<StructuralSprings>(std::move(model), {{}, springs});
}

/// Adds the springs' forces.
void add(const std::vector<SpringOf<float>>& springs, const LaneField& x, const LaneField& v, LaneField& f) {
  force_kernels(lanes).add[index_of<StructuralSprings>](
      {model_of(x.x.size() / lanes, springs), lanes, x.field(), f.field()}, {v.field()});
}

class SpringForces : public tests::OnEveryTarget {};

TEST_P(SpringForces, OneSpringHasTheClosedFormInEachLane) {
  std::mt19937 random(1);
  LaneField x(2), v(2), f(2);
  x.randomise(random, 1);
  v.randomise(random, 3);
  const std::vector<SpringOf<float>> spring{{0, 1, 0.8f, 120.0f, 2.5f}};
  add(spring, x, v, f);
  for (int l = 0; l < lanes; ++l) {
    const glm::dvec3 expected = pull(x, v, spring[0], l);
    EXPECT_NEAR(glm::distance(f.at(0, l), expected), 0, 2e-6 * (glm::length(expected) + 100)) << "lane " << l;
    EXPECT_EQ(f.at(0, l), -f.at(1, l));
  }
}

TEST_P(SpringForces, OfLengthZeroPullsNowhere) {
  LaneField x(2), v(2), f(2);
  for (int l = 0; l < lanes; ++l) {
    x.set(0, l, {1, 2, 3});
    x.set(1, l, {1, 2, 3});
    v.set(0, l, {1.0 * l, 0, 0});
  }
  x.set(1, 5, {1, 2, 4});  // its neighbours do not disturb a lane
  const std::vector<SpringOf<float>> spring{{0, 1, 0.5f, 100.0f, 1.0f}};
  add(spring, x, v, f);
  for (int l = 0; l < lanes; ++l)
    EXPECT_EQ(f.at(0, l), l == 5 ? glm::dvec3(0, 0, 50) : glm::dvec3(0.0)) << "lane " << l;
}

INSTANTIATE_TEST_SUITE_P(All, SpringForces, testing::ValuesIn(tests::targets()), tests::target_name);

TEST(Kernels, KickAndDriftLeaveBodiesThatDoNotMoveAlone) {
  for (const std::int64_t target : tests::targets()) {
    const tests::UseTarget use(target);
    std::mt19937 random(4);
    LaneField x(3), v(3), f(3);
    x.randomise(random, 1);
    v.randomise(random, 1);
    f.randomise(random, 1);
    const LaneField x0 = x, v0 = v;
    float moves[lanes];
    for (int l = 0; l < lanes; ++l) moves[l] = l % 3 == 1 ? 0.0f : 1.0f;
    state_kernels(lanes).kick(lanes, {3, 1, 0.5f, 0.25f, -1, 2, moves}, std::as_const(f).field(), v.field());
    state_kernels(lanes).add(lanes, 3, moves, 0.125f, std::as_const(v).field(), x.field());
    for (std::size_t i = 0; i < 3; ++i)
      for (int l = 0; l < lanes; ++l) {
        const glm::dvec3 dv = double(moves[l]) * (0.5 * f.at(i, l) + glm::dvec3(0.25, -1, 2));
        EXPECT_NEAR(glm::distance(v.at(i, l), v0.at(i, l) + dv), 0, 1e-6);
        EXPECT_NEAR(glm::distance(x.at(i, l), x0.at(i, l) + 0.125 * double(moves[l]) * v.at(i, l)), 0, 1e-6);
      }
  }
}

TEST(Kernels, ExtentIsTheBoxAndTheFastestOfEachLane) {
  for (const std::int64_t target : tests::targets()) {
    const tests::UseTarget use(target);
    std::mt19937 random(5);
    LaneField x(20), v(20);
    x.randomise(random, 4);
    v.randomise(random, 4);
    Extent e;
    state_kernels(lanes).extent(lanes, 20, std::as_const(x).field(), std::as_const(v).field(), e);
    for (int l = 0; l < lanes; ++l) {
      glm::dvec3 lo = x.at(0, l), hi = lo;
      double speed2 = 0;
      for (std::size_t i = 0; i < 20; ++i) {
        lo = glm::min(lo, x.at(i, l)), hi = glm::max(hi, x.at(i, l));
        speed2 = std::max(speed2, glm::dot(v.at(i, l), v.at(i, l)));
      }
      EXPECT_EQ(glm::dvec3(e.lo.x[l], e.lo.y[l], e.lo.z[l]), lo);
      EXPECT_EQ(glm::dvec3(e.hi.x[l], e.hi.y[l], e.hi.z[l]), hi);
      EXPECT_NEAR(e.length2[l], speed2, 1e-5 * speed2);
    }
  }
}

}  // namespace THIS_FILE
}  // namespace softbody::test
