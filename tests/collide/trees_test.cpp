// Trees of boxes: what holds of every node, and what a search of them finds.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "collide/core/body_boxes.h"
#include "collide/core/cutoff.h"
#include "collide/trees/body_trees.h"
#include "collide/trees/point_tree.h"
#include "states.h"

namespace collide::test {

using namespace collide::trees;
namespace THIS_FILE {

/// Halves across x, in the order of the items; a node whose items share their x is a leaf.
Parts halve_by_x(std::span<const Item> items, const Aabb& box, Item* to) {
  if (!(box.lo.x < box.hi.x)) return {};
  std::copy(items.begin(), items.end(), to);
  std::sort(to, to + items.size(), [](const Item& a, const Item& b) { return a.at[0] < b.at[0]; });
  const auto low = static_cast<Index>(items.size() / 2);
  return {{low, static_cast<Index>(items.size()) - low}, 2};
}

/// Expects that the node's box is the smallest one around its slots, and that its leaves are its slots. Returns these.
Range check(std::span<const Node> nodes, const Points& points, Index at, Index leaf_size) {
  const Node& node = nodes[at];
  Range slots = node.slots();
  if (node.is_leaf()) {
    EXPECT_TRUE(node.size <= leaf_size || node.box.lo.x == node.box.hi.x) << node.size;
  } else {
    for (Index child = 0; child < node.children; ++child) {
      EXPECT_GT(node.first + child, at) << "children lie behind their parents";
      const Range below = check(nodes, points, node.first + child, leaf_size);
      if (child == 0) slots = {below.begin, below.begin};
      EXPECT_EQ(below.begin, slots.end);
      slots.end = below.end;
    }
  }
  EXPECT_EQ(slots.size(), node.size);
  const auto [x_lo, x_hi] = std::ranges::minmax(std::span(points.x).subspan(slots.begin, slots.size()));
  const auto [y_lo, y_hi] = std::ranges::minmax(std::span(points.y).subspan(slots.begin, slots.size()));
  const auto [z_lo, z_hi] = std::ranges::minmax(std::span(points.z).subspan(slots.begin, slots.size()));
  EXPECT_EQ(node.box.lo, glm::vec3(x_lo, y_lo, z_lo));
  EXPECT_EQ(node.box.hi, glm::vec3(x_hi, y_hi, z_hi));
  return slots;
}

/// Expects every vertex of the live bodies in one slot, where it is in the frame.
void check_points(const State& state, const Points& points, std::span<const Index> live) {
  std::vector<Index> expected, seen(points.vertex.begin(), points.vertex.begin() + points.size());
  for (const Index body : live) {
    for (Index v = state.bodies.first[body]; v < state.bodies.first[body + 1]; ++v) expected.push_back(v);
  }
  std::ranges::sort(seen);
  EXPECT_EQ(seen, expected);
  for (Index slot = 0; slot < points.size(); ++slot) {
    const Index v = points.vertex[slot];
    EXPECT_EQ(glm::vec3(points.x[slot], points.y[slot], points.z[slot]), glm::vec3(state.x[v], state.y[v], state.z[v]));
    EXPECT_EQ(points.body[slot], state.bodies.body_of(v));
  }
}

TEST(PointTree, HoldsEveryVertexInTheLeafOfItsPlace) {
  for (const NamedState& named : named_states()) {
    SCOPED_TRACE(named.name);
    const State state = named.make();
    BodyBoxes bodies;
    Result result;
    bodies.build(state.frame(), result);
    for (const int threads : {1, 2, 5}) {
      Workers workers(threads, 0);
      PointTree tree;
      tree.build(state.frame(), bodies.live, halve_by_x, 7, workers);
      check_points(state, tree.points(), bodies.live);
      ASSERT_EQ(tree.nodes().empty(), bodies.live.empty());
      if (tree.nodes().empty()) continue;
      EXPECT_EQ(check(tree.nodes(), tree.points(), 0, 7).size(), tree.points().size());
    }
  }
}

TEST(BodyTrees, AreRefittedAsBodiesMoveComeAndGo) {
  const Ball ball = icosphere(2, 0.5f);
  const auto shape = std::make_shared<const Shape>(162, ball.edges, ball.vertices);
  Workers workers(2, 0);
  BodyTrees trees;
  std::mt19937 random(52);
  for (int frame = 0; frame < 12; ++frame) {
    State state;
    const int bodies = frame % 5 + (frame == 7 ? 0 : 1);
    for (int body = 0; body < bodies; ++body) {
      if (body % 3 == 2) {
        state.add(random_points(random, 40, -1, 1));
      } else {
        state.add(shape, moved(ball.vertices, random_points(random, 1, -3, 3)[0]));
      }
    }
    if (frame == 4) state.add({});
    std::vector<Index> live;
    for (Index body = 0; body < state.bodies.count(); ++body) {
      if (state.bodies.size(body) > 0 && !(frame == 9 && body == 0)) live.push_back(body);
    }
    trees.update(state.frame(), live, workers);
    check_points(state, trees.points(), live);
    for (std::size_t k = 0; k < live.size(); ++k) {
      const Node& root = trees.nodes_of(k).front();
      const auto at = static_cast<Index>(&root - trees.nodes().data());
      EXPECT_TRUE(root.whole_body);
      EXPECT_EQ(check(trees.nodes(), trees.points(), at, BodyTrees::patch_size).size(), state.bodies.size(live[k]));
    }
    EXPECT_EQ(trees.upper().size(), live.empty() ? 0 : 2 * live.size() - 1);
  }
}

/// The first of 162 vertices are of one patch in each body of a mesh, until the cuts are forgotten.
TEST(BodyTrees, KeepTheCutsOfAMeshUntilTheyForget) {
  const Ball ball = icosphere(2, 0.5f);
  const auto shape = std::make_shared<const Shape>(162, ball.edges, ball.vertices);
  std::vector<glm::vec3> crumpled = ball.vertices;
  std::ranges::reverse(crumpled);
  const auto order = [](const BodyTrees& trees) {
    return std::vector(trees.points().vertex.begin(), trees.points().vertex.begin() + 162);
  };
  State before, after;
  before.add(shape, ball.vertices);
  after.add(shape, crumpled);
  Workers workers(1);
  BodyTrees trees;
  const std::vector<Index> live{0};
  trees.update(before.frame(), live, workers);
  const std::vector<Index> first = order(trees);
  trees.update(after.frame(), live, workers);
  EXPECT_EQ(order(trees), first);
  trees.forget();
  trees.update(after.frame(), live, workers);
  EXPECT_NE(order(trees), first);
}

TEST(BodyTrees, AreCutAnewByTheBodyWhosePatchesHaveSpread) {
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
  check_points(after, trees.points(), live);
}

TEST(TreeSearch, FindsTheContactsOfAnyTree) {
  for (const NamedState& named : named_states()) {
    const State state = named.make();
    const Frame frame = state.frame();  // which the search keeps
    BodyBoxes bodies;
    Settings settings;
    settings.tolerance = state.tolerance;
    for (const int threads : {1, 3}) {
      settings.self_collision = threads == 1;
      Workers workers(threads, 0);
      PointTree tree;
      TreeSearch tree_search;
      ContactSearch search;
      Result result;
      bodies.build(frame, result);
      tree.build(frame, bodies.live, halve_by_x, 3, workers);
      search.begin(frame, settings, tree.points(), threads);
      tree_search.run(tree.nodes(), settings.self_collision, contact_cutoff(settings.tolerance), search, workers);
      search.finish(result);
      EXPECT_EQ(result.contacts, oracle(state, settings)) << named.name << ' ' << threads;
    }
  }
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
    Settings settings;
    settings.tolerance = tolerance;
    for (const char* method : {"octree", "kd-tree"}) {
      EXPECT_EQ(detect(method, state, settings).contacts, oracle(state, settings)) << method << tolerance;
    }
  }
}

}  // namespace THIS_FILE
}  // namespace collide::test
