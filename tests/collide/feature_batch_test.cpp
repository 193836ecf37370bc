// Compares batches of feature pairs with single pairs: equal to the bit on every target.

#include "collide/surface/feature_batch.h"

#include <gtest/gtest.h>

#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "every_target.h"
#include "surface_meshes.h"

namespace collide::test {

using namespace collide::surface;
namespace THIS_FILE {

class FeatureBatchOnTargets : public OnEveryTarget {
 protected:
  /// Returns random corners. A third of them lie on a coarse grid, so that closest points lie on sides and corners,
  /// edges are parallel, and faces are slivers or points.
  std::array<glm::vec3, 4> corners() {
    std::array<glm::vec3, 4> c{};
    const bool coarse = random_() % 3 == 0;
    for (glm::vec3& p : c) {
      p = random_points(random_, 1, -1, 1)[0];
      if (coarse) p = glm::round(p);
    }
    if (random_() % 8 == 0) c[3] = c[2] + 1e-5f * c[3];
    return c;
  }
  static void expect_equal(const Closest& all, float distance2, const Closest& one) {
    EXPECT_EQ(std::memcmp(all.weight, one.weight, sizeof one.weight), 0);
    EXPECT_EQ(all.separation, one.separation);
    EXPECT_EQ(all.inner, one.inner);
    EXPECT_EQ(distance2, glm::dot(one.separation, one.separation));
  }
};

TEST_P(FeatureBatchOnTargets, EqualsClosestFeaturesToTheBit) {
  for (int trial = 0; trial < 200; ++trial) {
    FeatureBatch batch;
    std::vector<std::array<glm::vec3, 4>> all(1 + random_() % FeatureBatch::capacity);
    for (auto& c : all) c = corners(), batch.add(c, 7);
    EXPECT_EQ(batch.full(), all.size() == FeatureBatch::capacity);
    batch.find_closest_edges();
    for (Index i = 0; i < all.size(); ++i) {
      const auto& [p, q, r, s] = all[i];
      expect_equal(batch.closest_edges(i), batch.distance2(i), closest_edges(p, q, r, s));
    }
    batch.find_closest_vertex_faces();
    for (Index i = 0; i < all.size(); ++i) {
      const auto& [p, a, b, c] = all[i];
      expect_equal(batch.closest_vertex_face(i), batch.distance2(i), closest_vertex_face(p, a, b, c));
      EXPECT_EQ(batch.corner(2, i), b);
      EXPECT_EQ(batch.tag(i), 7u);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, FeatureBatchOnTargets, testing::ValuesIn(targets()), target_name);

}  // namespace THIS_FILE
}  // namespace collide::test
