// The paper's literal method finds what §2.3 says, and nothing else.

#include <gtest/gtest.h>

#include <algorithm>

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
        const Settings settings{.tolerance = state.tolerance,
                                .self_collision = self,
                                .levels = levels,
                                .buckets = 251,
                                .cell_size = glm::vec3(0.4f)};
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

TEST(Literal, TellsAlongEachAxisWhetherABoxExceedsACell) {
  State state;
  state.add({glm::vec3(0), glm::vec3(1, 2, 3)});
  const Settings settings{.levels = 0, .cell_size = glm::vec3{1, 2, 3}};
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
