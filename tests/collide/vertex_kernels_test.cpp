// The loops over the vertices of a body against plain scalar code, on every target.

#include "collide/core/vertex_kernels.h"

#include <glm/matrix.hpp>

#include "every_target.h"

namespace collide::test {
namespace {

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

/// Whatever the map, its residuals are what the comment says; and an affine image of the reference has hardly any.
TEST_P(VertexKernels, ResidualsAreThoseOfTheMap) {
  for (const Index size : {16u, 17u, 31u, 42u, 127u, 128u, 162u, 333u}) {
    std::vector<glm::vec3> points = random_points(random_, size, -1, 1);
    glm::dvec3 mean(0);
    double samples = 0;
    for_samples(size, [&](Index v) { mean += glm::dvec3(points[v]), samples += 1; });
    for (glm::vec3& p : points) p -= glm::vec3(mean / samples);
    glm::dmat3 moment(0);
    for_samples(size, [&](Index v) { moment += glm::outerProduct(glm::dvec3(points[v]), glm::dvec3(points[v])); });
    const glm::mat3 symmetric(glm::inverse(moment));
    std::array<float, 9> inverse;
    std::copy_n(&symmetric[0][0], 9, inverse.begin());
    const Points3 reference(points);
    const glm::vec3 centre(3, -2, 1);
    for (const float noise : {0.0f, 0.2f}) {
      std::vector<glm::vec3> image = random_points(random_, size, -noise, noise);
      for (Index v = 0; v < size; ++v) {
        const glm::vec3& p = points[v];
        image[v] += centre + glm::vec3(0.5f * p.x + 0.3f * p.y + 0.1f, -0.7f * p.y + p.z, 0.2f * p.x + p.z - 0.3f);
      }
      const Points3 body(image);
      std::vector<float> residual2(size);
      const AffineFit fit = fit_affine(body.run(), reference.run(), inverse, centre, residual2);
      float greatest = 0;
      for (Index v = 0; v < size; ++v) {
        const auto error = [&](std::size_t row, float at, float middle) {
          const float* const r = &fit.matrix[3 * row];
          const float mapped = r[0] * reference.x[v] + r[1] * reference.y[v] + r[2] * reference.z[v];
          return at - middle - fit.offset[row] - mapped;
        };
        const float x = error(0, body.x[v], centre.x), y = error(1, body.y[v], centre.y),
                    z = error(2, body.z[v], centre.z);
        ASSERT_EQ(residual2[v], x * x + y * y + z * z);
        greatest = std::max(greatest, residual2[v]);
      }
      EXPECT_EQ(fit.residual, std::sqrt(greatest));
      if (noise == 0) {
        EXPECT_LT(fit.residual, 1e-5f) << size;
        EXPECT_NEAR(fit.matrix[4], -0.7, 1e-4);
      }
    }
  }
}

TEST_P(VertexKernels, ListsWhatIsAboveALimit) {
  for (const Index size : {16u, 17u, 31u, 64u, 101u}) {
    for (const float limit : {-2.0f, -0.5f, 0.0f, 0.9f, 2.0f}) {
      std::vector<float> values = Points3(random_points(random_, size, -1, 1)).x;
      values[size / 2] = nan;
      values[size / 3] = limit;
      std::vector<Index> above, list(size + max_lanes);
      for (Index v = 0; v < size; ++v) {
        if (!(values[v] <= limit)) above.push_back(v);
      }
      list.resize(list_above(values, limit, list.data()));
      EXPECT_EQ(list, above) << size << ", " << limit;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, VertexKernels, testing::ValuesIn(targets()), target_name);

}  // namespace
}  // namespace collide::test
