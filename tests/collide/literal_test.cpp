// What the paper's literal method finds and what it misses.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "collide/methods/subdivision.h"
#include "states.h"

namespace collide::test {

using namespace collide::methods;
namespace THIS_FILE {

/// The boxes of a frame and which of them share a bucket, by the detector's own picture of them.
class Boxes {
 public:
  Boxes(const State& state, const Settings& settings, DebugGeometry geometry)
      : self_(settings.self_collision), geometry_(std::move(geometry)), of_vertex_(state.x.size()) {
    Workers workers(1);
    Result result;
    BodyBoxes bodies;
    Subdivision subdivision;
    bodies.build(state.frame(), result);
    subdivision.build(state.frame(), bodies, bodies.live, settings.levels, workers);
    for (const SubdividedBox& box : subdivision.boxes()) {
      for (Index slot = box.slots.begin; slot < box.slots.end; ++slot) {
        of_vertex_[subdivision.points().vertex[slot]] = vertices_.size();
      }
      vertices_.push_back(box.slots.size());
    }
  }

  /// §2.3: a box meets itself, and those with which it shares a bucket.
  bool meet(std::size_t a, std::size_t b) const {
    if (geometry_.boxes[a].body == geometry_.boxes[b].body && !self_) return false;
    const auto buckets = [&](std::size_t box) {
      return std::span(geometry_.box_bucket)
          .subspan(geometry_.box_first[box], geometry_.box_first[box + 1] - geometry_.box_first[box]);
    };
    const auto of_a = buckets(a), of_b = buckets(b);
    return a == b || std::find_first_of(of_a.begin(), of_a.end(), of_b.begin(), of_b.end()) != of_a.end();
  }
  bool meet(const Contact& contact) const { return meet(of_vertex_[contact.a], of_vertex_[contact.b]); }

  std::uint64_t pair_tests() const {
    std::uint64_t tests = 0;
    for (std::size_t a = 0; a < vertices_.size(); ++a) {
      for (std::size_t b = a; b < vertices_.size(); ++b) {
        if (meet(a, b)) tests += a == b ? vertices_[a] * (vertices_[a] - 1) / 2 : vertices_[a] * vertices_[b];
      }
    }
    return tests;
  }

 private:
  bool self_;
  DebugGeometry geometry_;
  std::vector<std::size_t> of_vertex_;   // the box of each vertex
  std::vector<std::uint64_t> vertices_;  // of each box
};

TEST(Literal, TestsExactlyTheVerticesOfBoxesThatShareABucket) {
  Workers workers(2, 0);
  for (const NamedState& named : named_states()) {
    const State state = named.make();
    for (const int levels : {0, 2, 5, 9}) {
      for (const bool self : {true, false}) {
        Settings settings;
        settings.tolerance = state.tolerance;
        settings.self_collision = self;
        settings.levels = levels;
        settings.buckets = 251;
        settings.cell_size = glm::vec3(0.4f);
        const auto detector = find_method("multi-level-sb")->make();
        Result result;
        detector->detect(state.frame(), settings, workers, result);

        const Boxes boxes(state, settings, detector->debug());
        std::vector<Contact> expected = oracle(state, settings);
        std::erase_if(expected, [&](const Contact& contact) { return !boxes.meet(contact); });
        ASSERT_EQ(result.contacts, expected) << named.name << ' ' << levels << ' ' << self;
        ASSERT_EQ(result.counters.pair_tests, boxes.pair_tests()) << named.name << ' ' << levels << ' ' << self;
      }
    }
  }
}

/// §2.4 at three levels: all eight boxes share the body's middle point, hence a bucket.
TEST(Literal, FindsEverySelfContactAtThreeLevels) {
  for (const NamedState& named : named_states()) {
    const State state = named.make();
    for (const float cell : {0.01f, 0.25f, 1.0f}) {
      for (const std::uint32_t buckets : {101u, 65537u}) {
        Settings settings;
        settings.tolerance = state.tolerance;
        settings.cell_size = glm::vec3(cell);
        settings.buckets = buckets;
        EXPECT_EQ(inside_bodies(state, detect("multi-level-sb", state, settings).contacts),
                  inside_bodies(state, oracle(state, settings)))
            << named.name << ' ' << cell << ' ' << buckets;
      }
    }
  }
}

/// Two spheres of radius 0.5 m that touch, tolerance 0.2 r, in many places and directions: found by true contacts.
/// The cell is given by the edge of an octant's box, which is the radius.
double recall(float cell_by_edge, std::uint32_t buckets) {
  const Ball ball = icosphere(2, 0.5f);
  const auto detector = find_method("multi-level-sb")->make();
  Workers workers(1);
  std::mt19937 random(21);
  std::size_t found = 0, all = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const glm::vec3 at = random_points(random, 1, -3, 3)[0], towards = random_points(random, 1, -1, 1)[0];
    const float length = std::sqrt(towards.x * towards.x + towards.y * towards.y + towards.z * towards.z);
    State state;
    state.add(moved(ball.vertices, at));
    state.add(moved(ball.vertices, at + towards * (0.98f / length)));
    Settings settings;
    settings.tolerance = 0.1f;
    settings.self_collision = false;
    settings.buckets = buckets;
    settings.cell_size = glm::vec3(0.5f * cell_by_edge);
    Result result;
    detector->detect(state.frame(), settings, workers, result);
    EXPECT_EQ(result.coverage, cell_by_edge < 1 ? Coverage::exceeded : Coverage::covered);
    found += result.contacts.size();
    all += oracle(state, settings).size();
  }
  EXPECT_GT(all, 250u);
  return static_cast<double>(found) / static_cast<double>(all);
}

constexpr std::uint32_t hardly_any_aliasing = 262139;  // a prime

TEST(Literal, MissesContactsWhereABoxExceedsACell) {
  EXPECT_LT(recall(0.25f, hardly_any_aliasing), 0.03);  // 0.01
  EXPECT_LT(recall(0.5f, hardly_any_aliasing), 0.2);    // 0.11
  EXPECT_LT(recall(0.75f, hardly_any_aliasing), 0.9);   // 0.82
}

TEST(Literal, MissesLittleWhereNoBoxExceedsACell) {
  EXPECT_GT(recall(1.01f, hardly_any_aliasing), 0.98);
  EXPECT_GT(recall(1.2f, hardly_any_aliasing), 0.98);
}

TEST(Literal, HidesMissesBehindAliasingInASmallTable) { EXPECT_GT(recall(0.25f, 101), 0.15); }

TEST(Literal, TellsAlongEachAxisWhetherABoxExceedsACell) {
  State state;
  state.add({glm::vec3(0), glm::vec3(1, 2, 3)});
  Settings settings;
  settings.levels = 0;
  settings.cell_size = glm::vec3{1, 2, 3};
  EXPECT_EQ(detect("multi-level-sb", state, settings).coverage, Coverage::covered);
  for (int axis = 0; axis < 3; ++axis) {
    Settings smaller = settings;
    (*smaller.cell_size)[axis] -= 0.001f;
    EXPECT_EQ(detect("multi-level-sb", state, smaller).coverage, Coverage::exceeded) << axis;
  }
}

/// Boxes are not padded: of two vertices on the two sides of a cell face, each alone in its box, none sees the other.
TEST(Literal, MissesAContactAcrossACellFace) {
  State state;
  state.add({glm::vec3(0.96f, 0.5f, 0.5f)});
  state.add({glm::vec3(1.04f, 0.5f, 0.5f)});
  EXPECT_EQ(oracle(state, metre_cells()).size(), 1u);
  const Result result = detect("multi-level-sb", state, metre_cells());
  EXPECT_EQ(result.contacts.size(), 0u);
  EXPECT_EQ(result.coverage, Coverage::covered);
  EXPECT_EQ(detect("multi-level-sb-complete", state, metre_cells()).contacts, oracle(state, metre_cells()));
}

}  // namespace THIS_FILE
}  // namespace collide::test
