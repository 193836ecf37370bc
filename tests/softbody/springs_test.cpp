// The kernels of springs and of motion on every instruction set, each lane on its own. forces_test.cpp has the law of
// springs.

#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "softbody/mechanics/kernels.h"
#include "softbody/state/kernels.h"
#include "tests/every_target.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

class LaneKernels : public tests::OnEveryTarget {
 protected:
  std::mt19937 random{4};
};

TEST_P(LaneKernels, PullNowhereWhereASpringHasNoLength) {
  LaneField x(2), v(2), f(2);
  for (int l = 0; l < lanes; ++l) {
    x.set(0, l, {1, 2, 3});
    x.set(1, l, {1, 2, 3});
    v.set(0, l, {1.0 * l, 0, 0});
  }
  x.set(1, 5, {1, 2, 4});  // its neighbours do not disturb a lane
  const std::vector<SpringOf<float>> spring{{0, 1, 0.5f, 100.0f, 1.0f}};
  BodyModel model;
  model.mesh.vertices.resize(2);
  model = with_force<StructuralSprings>(std::move(model), {{}, spring});
  force_kernels(lanes).add[index_of<StructuralSprings>]({model, lanes, x.field(), f.field()}, {v.field()});
  for (int l = 0; l < lanes; ++l)
    EXPECT_EQ(f.at(0, l), l == 5 ? glm::dvec3(0, 0, 50) : glm::dvec3(0.0)) << "lane " << l;
}

TEST_P(LaneKernels, LeaveBodiesThatDoNotMoveAlone) {
  LaneField x(3), v(3), f(3);
  for (LaneField* field : {&x, &v, &f}) field->randomise(random, 1);
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

TEST_P(LaneKernels, FindTheBoxAndTheFastestOfEachLane) {
  LaneField x(20), v(20);
  for (LaneField* field : {&x, &v}) field->randomise(random, 4);
  Extent e;
  state_kernels(lanes).extent(lanes, 20, std::as_const(x).field(), std::as_const(v).field(), e);
  for (int l = 0; l < lanes; ++l) {
    glm::dvec3 lo = x.at(0, l), hi = lo;
    double speed2 = 0;
    for (std::size_t i = 0; i < 20; ++i) {
      lo = glm::min(lo, x.at(i, l)), hi = glm::max(hi, x.at(i, l));
      speed2 = std::max(speed2, glm::dot(v.at(i, l), v.at(i, l)));
    }
    EXPECT_EQ(glm::dvec3(e.lo[std::size_t(l)]), lo);
    EXPECT_EQ(glm::dvec3(e.hi[std::size_t(l)]), hi);
    EXPECT_NEAR(e.length2[l], speed2, 1e-5 * speed2);
  }
}

INSTANTIATE_TEST_SUITE_P(All, LaneKernels, testing::ValuesIn(tests::targets()), tests::target_name);

}  // namespace THIS_FILE
}  // namespace softbody::test
