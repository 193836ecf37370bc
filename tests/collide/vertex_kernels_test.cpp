// The loops over the vertices of a body against plain scalar code, on every target.

#include "collide/core/vertex_kernels.h"

#include "every_target.h"

namespace collide::test {
namespace THIS_FILE {

using VertexKernels = OnEveryTarget;

long double distance(const VertexRun& a, Index i, const VertexRun& b, Index j) {
  const long double dx = static_cast<long double>(a.x[i]) - static_cast<long double>(b.x[j]),
                    dy = static_cast<long double>(a.y[i]) - static_cast<long double>(b.y[j]),
                    dz = static_cast<long double>(a.z[i]) - static_cast<long double>(b.z[j]);
  return std::sqrt(dx * dx + dy * dy + dz * dz);
}

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
      const Points3 centre({bound.centre});
      for (Index v = 0; v < size; ++v) {
        const glm::vec3 p(points.x[v], points.y[v], points.z[v]);
        for (int axis = 0; axis < 3; ++axis)
          lo[axis] = std::min(lo[axis], p[axis]), hi[axis] = std::max(hi[axis], p[axis]);
        farthest = std::max(farthest, distance(points.run(), v, centre.run(), 0));
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
    // The inverse of the moment by Cramer's rule.
    std::array<double, 6> m{};
    for_samples(size, [&](Index v) {
      const glm::dvec3 p(points[v]);
      m[0] += p.x * p.x, m[1] += p.x * p.y, m[2] += p.x * p.z, m[3] += p.y * p.y, m[4] += p.y * p.z, m[5] += p.z * p.z;
    });
    const double a = m[3] * m[5] - m[4] * m[4], b = m[2] * m[4] - m[1] * m[5], c = m[1] * m[4] - m[2] * m[3];
    const double d = m[0] * m[5] - m[2] * m[2], e = m[1] * m[2] - m[0] * m[4], f = m[0] * m[3] - m[1] * m[1];
    const double det = m[0] * a + m[1] * b + m[2] * c;
    const std::array adjoint{a, b, c, b, d, e, c, e, f};
    std::array<float, 9> inverse;
    std::transform(adjoint.begin(), adjoint.end(), inverse.begin(),
                   [&](double value) { return static_cast<float>(value / det); });
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

}  // namespace THIS_FILE
}  // namespace collide::test
