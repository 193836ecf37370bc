// Counters on cases small enough to count by hand.

#include <gtest/gtest.h>

#include <optional>

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
  return {.buckets = buckets, .cell_size = glm::vec3(size)};
}

struct Case {
  std::string_view what, method;
  State state;
  Settings settings;
  std::optional<std::uint64_t> hashes = {}, boxes = {}, pair_tests = {};
  std::optional<std::size_t> buckets = {};    // that are in use
  std::optional<std::uint32_t> fullest = {};  // load of a bucket
  Coverage coverage = Coverage::exact;
};

Settings changed(Settings settings, const std::function<void(Settings&)>& change) {
  change(settings);
  return settings;
}

std::vector<Case> cases() {
  const auto no_self = [](Settings& s) { s.self_collision = false; };
  const auto level_0 = [](Settings& s) { s.levels = 0; };
  const Settings far = cells_of(10), near = cells_of(1, 65537), between = changed(cells_of(1), no_self);
  State bodies = cube(0);
  bodies.add({glm::vec3(2.05f), glm::vec3(3)});
  bodies.add({glm::vec3(50), glm::vec3(51)});
  using enum Coverage;
  return {
      // what, method, bodies, settings: hashes, boxes, pair tests, buckets, fullest bucket, coverage
      {"all pairs", "brute-force", cube(0), {}, 0, 0, 28, 0, 0},
      {"no pair of one body", "brute-force", cube(0), changed({}, no_self), 0, 0, 0, 0, 0},
      {"eight hashes a box, all in one cell", "multi-level-sb", cube(1), far, 64, 8, 28, 1, 8, covered},
      {"27 corners in 27 cells; the middle is in all boxes", "multi-level-sb", cube(0), near, 64, 8, 28, 27, 8,
       covered},
      {"a pair of boxes in two buckets", "multi-level-sb", cube(0), cells_of(1, 2), 64, 8, 28, 2, 8, covered},
      {"smaller cells", "multi-level-sb", cube(0), cells_of(0.999f), 64, 8, 28, {}, {}, exceeded},
      {"a box with itself", "multi-level-sb", cube(1), changed(far, level_0), 8, 1, 28, 1, 1, covered},
      {"padded boxes in one cell", "multi-level-sb-complete", cube(1), far, 8, 8, 28, 1, 8},
      {"padded boxes in three cells an axis", "multi-level-sb-complete", cube(0), near, 8 * 27, 8, 28},
      {"boxes in more than 64 cells meet all", "multi-level-sb-complete", cube(0), cells_of(0.25f), 0, 8, 28, 0, 0},
      {"a body's box, and the area in it, uncut", "multi-level-sb-exact", cube(1), far, 0, 2, 28, 0, 0},
      {"a body's box", "multi-level-sb-exact", cube(1), changed(far, no_self), 0, 1, 0, 0, 0},
      // 0.5 and 2.5 m are far from the borders at 0, 1.5 and 3 m.
      {"a cell a vertex, and visited", "grid-hash", cube(0.5f), cells_of(1.5f, 65537), 16, 0, 0, 8, 1},
      {"one cell", "grid-hash", cube(0.5f), cells_of(100, 65537), 16, 0, 28, 1, 8},
      {"three boxes and an overlap", "bounding-box", bodies, cells_of(1), 0, 3, 28 + 1 + 1 + 16, 0, 0},
      {"the overlap", "bounding-box", bodies, between, 0, 3, 16, 0, 0},
      {"2 and 2.05 m share a cell", "bounding-box-grid-hash", bodies, between, {}, 3, {}, 9, 2},
      {"the body far away is hashed, too", "grid-hash", bodies, between, {}, 0, {}, 11, 2},
  };
}

TEST(Counters, AreThoseCountedByHand) {
  Workers workers(1);
  for (const Case& c : cases()) {
    SCOPED_TRACE(testing::Message() << c.method << ": " << c.what);
    const std::unique_ptr<Detector> detector = find_method(c.method)->make();
    Result result;
    detector->detect(c.state.frame(), c.settings, workers, result);
    const std::vector<BucketLoad> loads = detector->debug().loads;
    std::uint32_t fullest = 0;
    for (const BucketLoad& one : loads) fullest = std::max(fullest, one.load);
    EXPECT_EQ(result.counters.hashes, c.hashes.value_or(result.counters.hashes));
    EXPECT_EQ(result.counters.boxes, c.boxes.value_or(result.counters.boxes));
    EXPECT_EQ(result.counters.pair_tests, c.pair_tests.value_or(result.counters.pair_tests));
    EXPECT_EQ(loads.size(), c.buckets.value_or(loads.size()));
    EXPECT_EQ(fullest, c.fullest.value_or(fullest));
    EXPECT_EQ(result.coverage, c.coverage);
  }
}

/// A box in 1000 cells, beside so many boxes in one cell that not all could be in 1000.
TEST(Counters, ShowThatTheCompleteMethodListsALargeBoxAmongMany) {
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

/// The sorted grid deals its cells to the axes by where most vertices are.
TEST(Counters, ShowThatABodyFarAwayTakesNoCellsOfTheSortedGridFromAPile) {
  const std::vector<glm::vec3> ball = icosphere(2, 0.2f).vertices;
  std::mt19937 random(3);
  State pile;
  for (const glm::vec3& at : random_points(random, 60, -1, 1)) pile.add(moved(ball, at));
  const Settings settings{.tolerance = 0.02f};
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
