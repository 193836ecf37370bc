#include "collide/methods/subdivision.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "states.h"

namespace collide::test {

using namespace collide::methods;
namespace THIS_FILE {

std::vector<SubdividedBox> boxes_of(const State& state, int levels, Points* points = nullptr) {
  Workers workers(2, 0);
  Result result;
  BodyBoxes bodies;
  Subdivision subdivision;
  bodies.build(state.frame(), result);
  subdivision.build(state.frame(), bodies, bodies.live, levels, workers);
  if (points != nullptr) *points = subdivision.points();
  return subdivision.boxes();
}

TEST(Cuts, FallOnTheAxesInTurn) {
  for (int levels = 0; levels <= max_levels; ++levels) {
    EXPECT_EQ(cuts_along(0, levels) + cuts_along(1, levels) + cuts_along(2, levels), levels);
    EXPECT_GE(cuts_along(0, levels), cuts_along(1, levels));
    EXPECT_GE(cuts_along(1, levels), cuts_along(2, levels));
    EXPECT_LE(cuts_along(0, levels), cuts_along(2, levels) + 1);
  }
  EXPECT_LE(cuts_along(0, max_levels), Cuts::max_depth);
}

TEST(Cuts, PutAValueOnTheMiddleAbove) {
  Cuts cuts;
  cuts.build(-1, 3, 2);
  EXPECT_EQ(cuts.border[1], 0.0f);
  EXPECT_EQ(cuts.border[2], 1.0f);
  EXPECT_EQ(cuts.interval_of(-1), 0);
  EXPECT_EQ(cuts.interval_of(0), 1);
  EXPECT_EQ(cuts.interval_of(std::nextafter(1.0f, 0.0f)), 1);
  EXPECT_EQ(cuts.interval_of(1), 2);
  EXPECT_EQ(cuts.interval_of(3), 3);
  cuts.build(5, 5, 3);  // flat: all go up
  EXPECT_EQ(cuts.interval_of(5), 7);
}

TEST(Subdivision, CutsACubeIntoItsOctants) {
  State state;
  std::vector<glm::vec3> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back(glm::vec3(static_cast<float>(i & 1), static_cast<float>(i >> 1 & 1), static_cast<float>(i >> 2)));
  }
  state.add(corners);
  const std::array<std::size_t, 4> expected{1, 2, 4, 8};
  for (int levels = 0; levels < 4; ++levels)
    EXPECT_EQ(boxes_of(state, levels).size(), expected[static_cast<std::size_t>(levels)]);
  const SubdividedBox first = boxes_of(state, 3)[0];
  EXPECT_EQ(first.region.lo, glm::vec3(0));
  EXPECT_EQ(first.region.hi, glm::vec3(0.5f));
}

TEST(Subdivision, PutsEveryVertexIntoOneBoxThatHoldsIt) {
  for (const NamedState& named : named_states()) {
    const State state = named.make();
    Settings settings;
    const std::vector<Index> left_out = detect("brute-force", state, settings).non_finite_bodies;
    std::size_t expected = state.x.size();
    for (const Index body : left_out) expected -= state.bodies.size(body);
    for (int levels = 0; levels <= max_levels; ++levels) {
      Points points;
      const std::vector<SubdividedBox> boxes = boxes_of(state, levels, &points);
      std::set<Index> seen;
      Index slot = 0;
      for (const SubdividedBox& box : boxes) {
        ASSERT_EQ(box.slots.begin, slot) << named.name;
        ASSERT_LT(box.slots.begin, box.slots.end) << named.name << ": an empty box";
        for (; slot < box.slots.end; ++slot) {
          const Index v = points.vertex[slot];
          seen.insert(v);
          ASSERT_EQ(points.body[slot], box.body);
          ASSERT_TRUE(v >= state.bodies.first[box.body] && v < state.bodies.first[box.body + 1]);
          const glm::vec3 p(state.x[v], state.y[v], state.z[v]);
          ASSERT_EQ(p, glm::vec3(points.x[slot], points.y[slot], points.z[slot]));
          for (int axis = 0; axis < 3; ++axis) {
            ASSERT_TRUE(box.region.lo[axis] <= p[axis] && p[axis] <= box.region.hi[axis]) << named.name << levels;
          }
        }
      }
      ASSERT_EQ(seen.size(), expected) << named.name << levels;
    }
  }
}

/// The recursion as method and paper put it, one cut after another.
TEST(Subdivision, IsTheRecursionOfMidpoints) {
  const State state = named_states()[0].make();
  Points points;
  const std::vector<SubdividedBox> boxes = boxes_of(state, 7, &points);
  for (const SubdividedBox& box : boxes) {
    const Index v = points.vertex[box.slots.begin];
    const glm::vec3 p(state.x[v], state.y[v], state.z[v]);
    Aabb region = boxes_of(state, 0)[box.body].region;
    for (int cut = 0; cut < 7; ++cut) {
      const int axis = cut % 3;
      const float mid = (region.lo[axis] + region.hi[axis]) / 2;
      (p[axis] >= mid ? region.lo : region.hi)[axis] = mid;
    }
    EXPECT_EQ(box.region.lo, region.lo);
    EXPECT_EQ(box.region.hi, region.hi);
  }
}

}  // namespace THIS_FILE
}  // namespace collide::test
