// When a detector remembers, how much of it, and what makes it forget.

#include "memory_rig.h"

namespace collide::test {
namespace {

using MemoryBounds = Memory;

/// Bodies whose own neighbours are hardly farther apart than the tolerance: a fresh search proves that they are, but
/// any margin finds them all. They sway.
State dense_pile() {
  State state;
  const Ball ball = icosphere(2, 0.5f);
  const auto shape = std::make_shared<const Shape>(static_cast<Index>(ball.vertices.size()), ball.edges, ball.vertices);
  for (int i = 0; i < 8; ++i)
    state.add(shape, moved(ball.vertices, 0.95f * glm::vec3(float(i % 2), float(i / 2 % 2), float(i / 4))));
  state.tolerance = tolerance;
  return state;
}

void sway(State& state, int frame) {
  std::mt19937 random(24);
  const std::vector<glm::vec3> speed = random_points(random, 8, -0.1f * tolerance, 0.1f * tolerance);
  for (Index body = 0; body < state.bodies.count(); ++body)
    shift(state, body, (frame % 40 < 20 ? 1.0f : -1.0f) * speed[body]);
}

TEST_P(MemoryBounds, IsLeftWhereAFreshSearchIsCheaper) {
  State state = dense_pile();
  int used = 0;
  for (int frame = 0; frame < 100; ++frame) {
    const std::uint64_t before = remembered_;
    see(state);
    used += remembered_ > before;
    sway(state, frame);
  }
  EXPECT_LT(used, 30);
}

/// All vertices in one point: a fresh search is dear enough to pay for any list, but lists have to be small.
TEST_P(MemoryBounds, HoldsNoMoreCandidatesThanItMay) {
  State state;
  for (int body = 0; body < 2; ++body) state.add(std::vector<glm::vec3>(800, glm::vec3(0)));
  state.tolerance = tolerance;
  for (int frame = 0; frame < 5; ++frame) see(state);
  ASSERT_GT(result_.contacts.size(), std::size_t{1} << 20);
  EXPECT_EQ(remembered_ + kept_, 0u);
}

/// Each half of them may be listed, both together may not: those of the second come while the first are remembered.
TEST_P(MemoryBounds, HoldsNoMoreCandidatesThanItMayWhereSomeAreAddedToOthers) {
  constexpr std::size_t size = 600;
  State state;
  state.tolerance = tolerance;
  for (const float x : {0.0f, 0.0f, 10.0f, 10.0f}) state.add(std::vector<glm::vec3>(size, glm::vec3(x, 0, 0)));
  for (std::size_t k = 0; k < 2 * size; ++k) state.y[2 * size + k] = float(k);
  for (int body = 0; body < 40; ++body) state.add({glm::vec3(-1.0f - float(body), 0, 0)});
  for (int frame = 0; frame < 12; ++frame) see(state);
  EXPECT_GT(result_.skip(Skip::kept_pairs), 0u) << "the first half";
  ASSERT_LT(result_.contacts.size(), std::size_t{1} << 20);
  std::fill_n(state.y.begin() + 2 * size, 2 * size, 0.0f);
  for (int frame = 0; frame < 5; ++frame) {
    see(state);
    EXPECT_EQ(result_.skip(Skip::kept_pairs) + result_.skip(Skip::remembered_pairs), 0u) << frame;
  }
  ASSERT_GT(result_.contacts.size(), std::size_t{1} << 20);
}

TEST_P(MemoryBounds, IsTakenUpAgainAtOnceWithOtherSettings) {
  State state = dense_pile();
  for (int frame = 0; frame < 75; ++frame) {  // pauses of 8, 16, 32 and, by now, 64 frames
    see(state);
    sway(state, frame);
  }
  const std::uint64_t before = remembered_ + kept_;
  for (int frame = 0; frame < 8; ++frame) see(state);
  EXPECT_EQ(remembered_ + kept_, before) << "it pauses";
  state.tolerance = 0.5f * tolerance;
  for (int frame = 0; frame < 8; ++frame) see(state);
  EXPECT_GT(kept_, 0u);
}

TEST_P(MemoryBounds, FollowsItsSettings) {
  State state = pile(2, true);
  for (const float other : {0.1f, 0.05f, 0.13f}) {
    for (const bool self : {true, false}) {
      for (const int levels : {3, 0, 15}) {
        state.tolerance = other;
        settings_.self_collision = self;
        settings_.levels = levels;
        for (int frame = 0; frame < 6; ++frame) see(state);
        EXPECT_GT(result_.skip(Skip::kept_pairs), 0u);
      }
    }
  }
}

TEST_P(MemoryBounds, RemembersNothingOnceToldToForget) {
  const State state = pile(2);
  see(state);
  const Result first = result_;
  for (int repeat = 0; repeat < 3; ++repeat) {
    for (int frame = 0; frame <= repeat * 2; ++frame) see(state);
    detector_->forget();
    see(state);
    EXPECT_EQ(result_.skipped, first.skipped);
    EXPECT_EQ(result_.counters.pair_tests, first.counters.pair_tests);
  }
}

INSTANTIATE_TEST_SUITE_P(Threads, MemoryBounds, testing::Values(1, 2, 3, 0), [](const auto& threads) {
  return threads.param == 0 ? std::string("switching") : std::to_string(threads.param);
});

}  // namespace
}  // namespace collide::test
