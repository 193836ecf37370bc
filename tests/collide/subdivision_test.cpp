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

/// The recursion as method and paper put it, one cut after another. A value on a cut belongs to the upper side.
TEST(Subdivision, IsTheRecursionOfMidpoints) {
  for (const std::size_t which : {std::size_t{0}, std::size_t{6}}) {  // a cloud, and a lattice with vertices on cuts
    const State state = named_states()[which].make();
    const std::vector<SubdividedBox> whole = boxes_of(state, 0);
    for (const int levels : {0, 1, 2, 3, 7, max_levels}) {
      Points points;
      for (const SubdividedBox& box : boxes_of(state, levels, &points)) {
        const Index v = points.vertex[box.slots.begin];
        const glm::vec3 p(state.x[v], state.y[v], state.z[v]);
        Aabb region = whole[box.body].region;
        for (int cut = 0; cut < levels; ++cut) {
          const int axis = cut % 3;
          const float mid = (region.lo[axis] + region.hi[axis]) / 2;
          (p[axis] >= mid ? region.lo : region.hi)[axis] = mid;
        }
        ASSERT_EQ(box.region.lo, region.lo) << levels;
        ASSERT_EQ(box.region.hi, region.hi) << levels;
      }
    }
  }
}

}  // namespace THIS_FILE
}  // namespace collide::test
