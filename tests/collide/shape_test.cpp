#include <gtest/gtest.h>

#include <stdexcept>

#include "states.h"

namespace collide::test {
namespace THIS_FILE {

using Edges = std::vector<std::array<Index, 2>>;

TEST(Shape, ExcludesMeshEdgesInBothDirections) {
  const Edges edges{{3, 1}, {0, 1}, {1, 3}, {2, 2}};
  const Shape shape(4, edges);
  EXPECT_EQ(shape.vertex_count(), 4u);
  for (Index i = 0; i < 4; ++i) {
    for (Index j = 0; j < 4; ++j) {
      const bool edge = (i == 1 && (j == 0 || j == 3)) || (j == 1 && (i == 0 || i == 3));
      EXPECT_EQ(shape.excludes(i, j, 1.0f), edge) << i << ' ' << j;
    }
  }
}

TEST(Shape, ExcludesRestDistancesBelowTheTolerance) {
  const Shape shape(3, Edges{}, {glm::vec3(0), glm::vec3(0.5f, 0, 0), glm::vec3(0, 2, 0)});
  EXPECT_FALSE(shape.excludes(0, 1, 0.25f));  // equal is not below
  EXPECT_TRUE(shape.excludes(0, 1, 0.2500001f));
  EXPECT_TRUE(shape.excludes(1, 0, 0.3f));
  EXPECT_FALSE(shape.excludes(0, 2, 0.3f));
}

TEST(Shape, RefusesWhatDoesNotFit) {
  EXPECT_THROW(Shape(2, Edges{{0, 2}}), std::invalid_argument);
  EXPECT_THROW(Shape(2, Edges{}, {glm::vec3(0)}), std::invalid_argument);
  EXPECT_EQ(Shape(0, Edges{}).vertex_count(), 0u);
}

}  // namespace THIS_FILE
}  // namespace collide::test
