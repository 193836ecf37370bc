// Pairs of features by the dozen against one by one: the same to the bit, on every instruction set.

#include "collide/surface/feature_pairs.h"

#include <gtest/gtest.h>

#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "every_target.h"
#include "surface_meshes.h"

namespace collide::test {

using namespace collide::surface;
namespace {

class FeaturePairsOnTargets : public OnEveryTarget {
 protected:
  /// Corners on a coarse grid now and then, so that closest points lie on sides and corners, edges are parallel and
  /// faces slivers or points.
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
    EXPECT_EQ(all.apart, one.apart);
    EXPECT_EQ(all.inner, one.inner);
    EXPECT_EQ(distance2, glm::dot(one.apart, one.apart));
  }
};

TEST_P(FeaturePairsOnTargets, AreAsCloseAsOneByOne) {
  for (int trial = 0; trial < 200; ++trial) {
    FeaturePairs pairs;
    std::vector<std::array<glm::vec3, 4>> all(1 + random_() % FeaturePairs::most);
    for (auto& c : all) c = corners(), pairs.add(c, 7);
    EXPECT_EQ(pairs.full(), all.size() == FeaturePairs::most);
    pairs.meet_edges();
    for (Index i = 0; i < all.size(); ++i) {
      const auto& [p, q, r, s] = all[i];
      expect_equal(pairs.closest_edges(i), pairs.distance2(i), closest_edges(p, q, r, s));
    }
    pairs.meet_vertices_and_faces();
    for (Index i = 0; i < all.size(); ++i) {
      const auto& [p, a, b, c] = all[i];
      expect_equal(pairs.closest_vertex_face(i), pairs.distance2(i), closest_vertex_face(p, a, b, c));
      EXPECT_EQ(pairs.corner(2, i), b);
      EXPECT_EQ(pairs.tag(i), 7u);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, FeaturePairsOnTargets, testing::ValuesIn(targets()), target_name);

}  // namespace
}  // namespace collide::test
