// The loops over the vertices of a body against plain scalar code, on every target.

#include "collide/core/vertex_kernels.h"

#include "every_target.h"

namespace collide::test {
namespace THIS_FILE {

using VertexKernels = OnEveryTarget;

TEST_P(VertexKernels, BoundHoldsEveryVertexAndIsTight) {
  int turn = 0;  // of the six sides, to be the one that lies farthest out
  for (const Index size : sizes) {
    for (const float scale : {1e-42f, 1e-21f, 1.0f, 1e15f, 1e38f}) {
      std::vector<glm::vec3> list = random_points(random_, size, -0.5f * scale, scale);
      for (glm::vec3& p : list) p[turn % 3] *= turn % 6 < 3 ? 2.0f : -2.0f;
      ++turn;
      const Points3 points(list);
      const BodyBounds bound = measure_bounds(points.run());
      ASSERT_TRUE(bound.finite);
      glm::vec3 lo(infinity), hi(-infinity);
      long double farthest = 0;
      for (Index v = 0; v < size; ++v) {
        const glm::vec3 p(points.x[v], points.y[v], points.z[v]);
        for (int axis = 0; axis < 3; ++axis)
          lo[axis] = std::min(lo[axis], p[axis]), hi[axis] = std::max(hi[axis], p[axis]);
        farthest = std::max(farthest, distance(p, bound.centre));
      }
      EXPECT_EQ(bound.box.lo, lo);
      EXPECT_EQ(bound.box.hi, hi);
      EXPECT_GE(static_cast<long double>(bound.radius), farthest);
      EXPECT_EQ(bound.largest, std::max({-lo.x, -lo.y, -lo.z, hi.x, hi.y, hi.z}));
      if (scale > 1e-15f && scale < 1e18f) {
        EXPECT_LE(static_cast<long double>(bound.radius), farthest * 1.000001L + 1e-22L);
      }
    }
  }
}

TEST_P(VertexKernels, BoundKnowsWhatIsNotFinite) {
  for (const Index size : sizes) {
    for (Index v = 0; v < size; ++v) {
      for (const float bad : {nan, infinity, -infinity}) {
        Points3 points(random_points(random_, size, -1, 1));
        (v % 3 == 0 ? points.x : v % 3 == 1 ? points.y : points.z)[v] = bad;
        EXPECT_FALSE(measure_bounds(points.run()).finite) << size << ' ' << v;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, VertexKernels, testing::ValuesIn(targets()), target_name);

}  // namespace THIS_FILE
}  // namespace collide::test
