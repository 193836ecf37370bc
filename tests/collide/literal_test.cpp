// What the paper's literal method finds and what it misses.

#include <gtest/gtest.h>

#include <cmath>

#include "states.h"

namespace collide::test {
namespace {

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

/// Boxes are not padded: of two vertices on the two sides of a cell face, each alone in its box, none sees the other.
TEST(Literal, MissesAContactAcrossACellFace) {
  State state;
  state.add({glm::vec3(0.96f, 0.5f, 0.5f)});
  state.add({glm::vec3(1.04f, 0.5f, 0.5f)});
  EXPECT_EQ(oracle(state, Settings{}).size(), 1u);
  const Result result = detect("multi-level-sb", state, Settings{});
  EXPECT_EQ(result.contacts.size(), 0u);
  EXPECT_EQ(result.coverage, Coverage::covered);
}

}  // namespace
}  // namespace collide::test
