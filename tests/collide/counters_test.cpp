// Counters on cases small enough to count by hand.

#include <gtest/gtest.h>

#include "states.h"

namespace collide::test {
namespace THIS_FILE {

/// The corners of a cube of 2 m: eight vertices, one in each octant.
State cube(float at) {
  State state;
  std::vector<glm::vec3> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back(glm::vec3(at) + 2.0f * glm::vec3(static_cast<float>(i & 1), static_cast<float>(i >> 1 & 1),
                                                       static_cast<float>(i >> 2)));
  }
  state.add(corners);
  return state;
}

Settings cells_of(float size, std::uint32_t buckets = 1001) {
  Settings settings;
  settings.cell_size = glm::vec3(size);
  settings.buckets = buckets;
  return settings;
}

/// Returns how many buckets a method uses, and the load of the fullest one; 0 of a method without a hash.
std::pair<std::size_t, std::uint32_t> bucket_loads(std::string_view method, const State& state,
                                                   const Settings& settings) {
  const std::unique_ptr<Detector> detector = find_method(method)->make();
  Workers workers(1);
  Result result;
  detector->detect(state.frame(), settings, workers, result);
  const std::vector<BucketLoad> loads = detector->debug().loads;
  std::uint32_t longest = 0;
  for (const BucketLoad& one : loads) longest = std::max(longest, one.load);
  return {loads.size(), longest};
}

TEST(Counters, OfBruteForceAreAllPairs) {
  const Counters counters = detect("brute-force", cube(0), {}).counters;
  EXPECT_EQ(counters.pair_tests, 28u);
  EXPECT_EQ(counters.hashes, 0u);
  EXPECT_EQ(counters.boxes, 0u);
  Settings settings;
  settings.self_collision = false;
  EXPECT_EQ(detect("brute-force", cube(0), settings).counters.pair_tests, 0u);
}

TEST(Counters, OfTheLiteralMethodAreEightHashesABox) {
  const Result result = detect("multi-level-sb", cube(1), cells_of(10));
  EXPECT_EQ(result.counters.boxes, 8u);
  EXPECT_EQ(result.counters.hashes, 64u);
  // All corners lie in the cell 0, 0, 0, each box once.
  EXPECT_EQ(bucket_loads("multi-level-sb", cube(1), cells_of(10)), std::pair(std::size_t{1}, 8u));
  EXPECT_EQ(result.counters.pair_tests, 28u);  // eight boxes of one vertex
  EXPECT_EQ(result.coverage, Coverage::covered);
}

TEST(Counters, CountAPairOfBoxesOnceThoughItSharesManyBuckets) {
  // Cells as large as the boxes: neighbours share up to four corners; 27 corner points fall into 27 cells.
  const Result result = detect("multi-level-sb", cube(0), cells_of(1, 65537));
  // The fullest is the middle of the body.
  EXPECT_EQ(bucket_loads("multi-level-sb", cube(0), cells_of(1, 65537)), std::pair(std::size_t{27}, 8u));
  EXPECT_EQ(result.counters.pair_tests, 28u);
  EXPECT_EQ(result.coverage, Coverage::covered);
  EXPECT_EQ(detect("multi-level-sb", cube(0), cells_of(1, 2)).counters.pair_tests, 28u);
  EXPECT_EQ(detect("multi-level-sb", cube(0), cells_of(0.999f)).coverage, Coverage::exceeded);
}

TEST(Counters, OfTheLiteralMethodIncludeABoxWithItself) {
  Settings settings = cells_of(10);
  settings.levels = 0;
  const Counters counters = detect("multi-level-sb", cube(1), settings).counters;
  EXPECT_EQ(counters.boxes, 1u);
  EXPECT_EQ(counters.hashes, 8u);
  EXPECT_EQ(counters.pair_tests, 28u);
}

TEST(Counters, OfTheCompleteMethodAreTheCellsOfPaddedBoxes) {
  const Counters inside = detect("multi-level-sb-complete", cube(1), cells_of(10)).counters;
  EXPECT_EQ(inside.boxes, 8u);
  EXPECT_EQ(inside.hashes, 8u);  // each box lies in the cell 0, 0, 0, padded or not
  EXPECT_EQ(inside.pair_tests, 28u);
  // Boxes of 1 m from 0 on, padded: three cells along each axis.
  EXPECT_EQ(detect("multi-level-sb-complete", cube(0), cells_of(1, 65537)).counters.hashes, 8u * 27);
  // More than 64 cells: no box is hashed, and all meet.
  const Counters everywhere = detect("multi-level-sb-complete", cube(0), cells_of(0.25f)).counters;
  EXPECT_EQ(everywhere.hashes, 0u);
  EXPECT_EQ(everywhere.pair_tests, 28u);
  EXPECT_EQ(detect("multi-level-sb-complete", cube(0), cells_of(0.999f)).coverage, Coverage::exact);
}

/// A box in 1000 cells, beside so many boxes in one cell that not all could be in 1000.
TEST(Counters, OfTheCompleteMethodListALargeBoxAmongMany) {
  State state;
  for (int i = 0; i < 40'000; ++i) state.add({glm::vec3(0.5f + 10 * static_cast<float>(i), 0.5f, 0.5f)});
  Settings settings = cells_of(1, 1'000'003);
  settings.levels = 0;
  const Counters without = detect("multi-level-sb-complete", state, settings).counters;
  state.add({glm::vec3(-20.5f), glm::vec3(-11.5f)});
  const Counters with = detect("multi-level-sb-complete", state, settings).counters;
  EXPECT_EQ(with.hashes, without.hashes + 1000);
  EXPECT_LT(with.pair_tests, without.pair_tests + 1000);
}

TEST(Counters, OfTheExactMethodHaveNoHashes) {
  const Counters counters = detect("multi-level-sb-exact", cube(1), cells_of(10)).counters;
  EXPECT_EQ(counters.hashes, 0u);
  EXPECT_EQ(bucket_loads("multi-level-sb-exact", cube(1), cells_of(10)).first, 0u);
  EXPECT_EQ(counters.boxes, 2u);  // the body's, and the area that it can touch itself in, uncut
  EXPECT_EQ(counters.pair_tests, 28u);
  Settings settings;
  settings.self_collision = false;
  EXPECT_EQ(detect("multi-level-sb-exact", cube(1), settings).counters.boxes, 1u);
  EXPECT_EQ(detect("multi-level-sb-exact", cube(1), settings).counters.pair_tests, 0u);
}

TEST(Counters, OfGridHashAreVerticesAndVisitedCells) {
  Settings settings = cells_of(1.5f, 65537);
  settings.tolerance = 0.1f;
  const Counters counters = detect("grid-hash", cube(0.5f), settings).counters;  // 0.5 and 2.5, far from 0, 1.5 and 3
  EXPECT_EQ(counters.hashes, 16u);  // each vertex into its cell, and its cell visited
  EXPECT_EQ(bucket_loads("grid-hash", cube(0.5f), settings).first, 8u);
  EXPECT_EQ(counters.pair_tests, 0u);
  settings.cell_size = glm::vec3(100);
  EXPECT_EQ(detect("grid-hash", cube(0.5f), settings).counters.pair_tests, 28u);
}

TEST(Counters, OfTheBoundingBoxMethodsFollowTheOverlap) {
  State state = cube(0);
  state.add({glm::vec3(2.05f), glm::vec3(3)});
  state.add({glm::vec3(50), glm::vec3(51)});
  Settings settings = cells_of(1);
  EXPECT_EQ(detect("bounding-box", state, settings).counters.boxes, 3u);
  EXPECT_EQ(detect("bounding-box", state, settings).counters.pair_tests, 28u + 1 + 1 + 16);
  settings.self_collision = false;
  EXPECT_EQ(detect("bounding-box", state, settings).counters.pair_tests, 16u);
  // 2 and 2.05 share a cell.
  EXPECT_EQ(bucket_loads("bounding-box-grid-hash", state, settings), std::pair(std::size_t{9}, 2u));
  EXPECT_EQ(bucket_loads("grid-hash", state, settings).first, 11u);
}

/// The sorted grid deals its cells to the axes by where most vertices are.
TEST(Counters, OfTheSortedGridAreThoseOfThePileThoughABodyIsFarAway) {
  const std::vector<glm::vec3> ball = icosphere(2, 0.2f).vertices;
  std::mt19937 random(3);
  State pile;
  for (const glm::vec3& at : random_points(random, 60, -1, 1)) pile.add(moved(ball, at));
  Settings settings;
  settings.tolerance = 0.02f;
  const std::uint64_t alone = detect("sorted-grid", pile, settings).counters.pair_tests;
  for (int axis = 0; axis < 3; ++axis) {
    State with_another = pile;
    glm::vec3 far(0);
    far[axis] = 1e6f;
    with_another.add(moved(ball, far));
    EXPECT_LT(detect("sorted-grid", with_another, settings).counters.pair_tests, alone + alone / 10) << axis;
  }
}

}  // namespace THIS_FILE
}  // namespace collide::test
