// Trees of boxes. The matrix holds what they find against the oracle.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "collide/trees/body_trees.h"
#include "states.h"

namespace collide::test {

using namespace collide::trees;
namespace THIS_FILE {

TEST(BodyTrees, AreCutAnewOnceThePatchesOfABodyHaveSpread) {
  const Ball ball = icosphere(3, 0.5f);
  const auto shape = std::make_shared<const Shape>(642, ball.edges, ball.vertices);
  std::mt19937 random(53);
  std::vector<glm::vec3> mixed = ball.vertices;
  std::ranges::shuffle(mixed, random);
  State before, after;
  for (const float at : {0.0f, 2.0f}) {
    before.add(shape, moved(ball.vertices, glm::vec3(at, 0, 0)));
    after.add(shape, moved(at > 0 ? mixed : ball.vertices, glm::vec3(at, 0, 0)));
  }
  Workers workers(2, 0);
  BodyTrees trees, fresh;
  const std::vector<Index> live{0, 1}, second{1};
  EXPECT_TRUE(trees.update(before.frame(), live, workers));
  EXPECT_FALSE(trees.update(before.frame(), live, workers));
  EXPECT_TRUE(trees.update(after.frame(), live, workers));
  fresh.update(after.frame(), second, workers);
  const auto boxes = [](std::span<const Node> nodes) {
    std::vector<float> sides;
    for (const Node& node : nodes) sides.push_back(node.box.hi.x - node.box.lo.x);
    return sides;
  };
  EXPECT_EQ(boxes(trees.nodes_of(1)), boxes(fresh.nodes_of(0)));
}

/// One point at each power of two: every cut into octants peels off a few of them.
TEST(Octree, IsAsDeepAsFloatsCanMakeIt) {
  State state;
  std::vector<glm::vec3> points;
  for (int power = -149; power < 128; ++power) {
    points.push_back(glm::vec3(std::ldexp(1.0f, power), 0, -std::ldexp(1.0f, power)));
  }
  state.add(points);
  for (const float tolerance : {1e-18f, 1.0f, 1e18f}) {
    const Settings settings{.tolerance = tolerance};
    for (const char* method : {"octree", "kd-tree"}) {
      EXPECT_EQ(detect(method, state, settings).contacts, oracle(state, settings)) << method << tolerance;
    }
  }
}

}  // namespace THIS_FILE
}  // namespace collide::test
