// Frames one after another through one detector, so that it remembers, against the oracle frame by frame. Each test
// asserts that the path that it is about was taken.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "memory_rig.h"

namespace collide::test {
namespace {

TEST_P(Memory, FollowsASlowDrift) {
  State state = pile(3);
  std::mt19937 random(22);
  const std::vector<glm::vec3> speed =
      random_points(random, state.bodies.count(), -0.03f * tolerance, 0.03f * tolerance);
  for (int frame = 0; frame < 40; ++frame) {
    see(state);
    for (Index body = 0; body < state.bodies.count(); ++body) shift(state, body, speed[body]);
    shake(state, random, 0.002f * tolerance);
  }
  EXPECT_GT(remembered_, 1000u);
  EXPECT_EQ(kept_, 0u);
}

TEST_P(Memory, FollowsOneThatFliesPastAPileAtRest) {
  State state = pile(3);
  state.add(state.bodies.shape[0], moved(icosphere(1, 0.5f).vertices, glm::vec3(-3, 2.6f, 1)));
  for (int frame = 0; frame < 30; ++frame) {
    see(state);
    if (frame < 24) shift(state, state.bodies.count() - 1, glm::vec3(0.25f, -0.01f, 0));
  }
  EXPECT_GT(remembered_, 0u);
  EXPECT_GT(kept_, 0u);
}

/// Two vertices exactly a tolerance apart are no contact; one unit in the last place nearer they are.
TEST_P(Memory, SeesABodyAtRestThatIsNudgedByOneUlp) {
  State state = pile(2);
  state.tolerance = 0.25f;
  state.add({glm::vec3(8, 0, 0)});
  state.add({glm::vec3(8.25f, 0, 0)});
  for (int frame = 0; frame < 8; ++frame) see(state);
  EXPECT_GT(kept_, 0u);
  const std::size_t before = result_.contacts.size(), at_rest = result_.skip(Skip::kept_pairs);
  state.x.back() = std::nextafter(8.25f, 0.0f);
  see(state);
  EXPECT_EQ(result_.contacts.size(), before + 1);
  EXPECT_EQ(result_.skip(Skip::kept_pairs), at_rest - 1);
  for (int frame = 0; frame < 12; ++frame) see(state);
  EXPECT_EQ(result_.skip(Skip::kept_pairs), at_rest) << "noted down anew where it lies now";
  state.x.back() = 8.25f;
  see(state);
  EXPECT_EQ(result_.contacts.size(), before);
}

TEST_P(Memory, SeesOneThatLeavesAndReturnsToTheBit) {
  for (const float far : {0.1f, 0.4f, 30.0f}) {  // tolerances: within the margin, beyond it, out of sight
    const State state = pile(3);
    for (const Index body : {0u, 13u, 26u}) {
      for (int frame = 0; frame < 6; ++frame) see(state, "there");
      State away = state;
      shift(away, body, glm::vec3(0, far * tolerance, 0));
      for (int frame = 0; frame < 4; ++frame) see(away, "away");
      for (int frame = 0; frame < 4; ++frame) see(state, "back");
    }
  }
  EXPECT_GT(kept_, 1000u);
}

TEST_P(Memory, SeesJumps) {
  State state = pile(3);
  std::mt19937 random(23);
  for (int frame = 0; frame < 40; ++frame) {
    see(state);
    if (frame % 4 != 3) continue;
    for (std::uint32_t jumps = random() % 12; jumps > 0; --jumps) {
      const std::size_t body = random() % state.bodies.count();
      shift(state, body, random_points(random, 1, -1, 1)[0]);
    }
  }
  EXPECT_GT(kept_, 0u);
}

TEST_P(Memory, LeavesOutABodyWhileItIsNotFinite) {
  const State state = pile(3);
  for (const Index body : {0u, 13u, 26u}) {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
      for (int frame = 0; frame < 6; ++frame) see(state, "before");
      State broken = state;
      broken.y[broken.bodies.first[body] + 7] = bad;
      for (int frame = 0; frame < 4; ++frame) {
        see(broken, "broken");
        EXPECT_EQ(result_.non_finite_bodies, (std::vector<Index>{body}));
      }
      EXPECT_GT(result_.skip(Skip::remembered_pairs), 0u) << "the others are still remembered";
      for (int frame = 0; frame < 4; ++frame) see(state, "after");
      EXPECT_TRUE(result_.non_finite_bodies.empty());
    }
  }
  EXPECT_GT(kept_, 0u);
}

TEST_P(Memory, ForgetsWhenBodiesOrShapesAreOthers) {
  State state = pile(2, true);
  const auto other_shape =
      std::make_shared<const Shape>(state.bodies.size(0), std::span<const std::array<Index, 2>>{});  // no edges
  const auto rest = [&](const char* what) {
    for (int frame = 0; frame < 6; ++frame) see(state, what);
    EXPECT_GT(result_.skip(Skip::kept_pairs), 0u) << what;
  };
  rest("first");
  const std::size_t before = result_.contacts.size();
  state.bodies.shape[3] = other_shape;
  see(state, "another shape");
  EXPECT_GT(result_.contacts.size(), before);
  rest("another shape");
  state.add(other_shape, moved(icosphere(1, 0.5f).vertices, glm::vec3(0.4f)));
  rest("one more");
  State fewer;  // without the first
  fewer.tolerance = tolerance;
  for (Index body = 1; body < state.bodies.count(); ++body) {
    std::vector<glm::vec3> vertices;
    for (Index v = state.bodies.first[body]; v < state.bodies.first[body + 1]; ++v) {
      vertices.push_back({state.x[v], state.y[v], state.z[v]});
    }
    fewer.add(state.bodies.shape[body], vertices);
  }
  state = fewer;
  rest("one less");
}

TEST_P(Memory, FollowsRandomWalksOfAnyStep) {
  for (const float step : {1e-4f, 1e-3f, 0.01f, 0.03f, 0.06f, 0.1f, 0.2f, 0.5f, 1.0f, 3.0f, 10.0f}) {  // tolerances
    State state = pile(2);
    std::mt19937 random(24);
    const std::uint64_t before = remembered_;
    for (int frame = 0; frame < 25; ++frame) {
      see(state);
      for (Index body = 0; body < state.bodies.count(); ++body) {
        shift(state, body, random_points(random, 1, -step * tolerance, step * tolerance)[0]);
      }
      shake(state, random, 0.1f * step * tolerance);
    }
    if (step < 0.3f) {
      EXPECT_GT(remembered_, before) << step;
    } else if (step > 2) {
      EXPECT_EQ(remembered_, before) << step << ": too fast to be remembered";
    }
  }
}

TEST_P(Memory, FollowsSelfContacts) {
  State state = pile(2, true);
  std::mt19937 random(25);
  std::uint64_t self = 0;
  for (int frame = 0; frame < 30; ++frame) {
    see(state);
    self += result_.self_contacts;
    shake(state, random, 0.03f * tolerance);
  }
  EXPECT_GT(self, 1000u);
  EXPECT_GT(remembered_, 100u);
}

/// Pairs of vertices that fly towards each other at many speeds from many distances, in two bodies or in one, among
/// many at rest: what the margin and the limits of staleness must hold against. A contact comes as late as can be.
TEST_P(Memory, MissesNoneThatComeTogether) {
  for (const std::uint32_t seed : {1u, 2u, 3u}) {
    std::mt19937 random(seed);
    State state;
    state.tolerance = tolerance;
    std::vector<glm::vec3> speed;  // of each vertex
    const auto place = [](int k) { return glm::vec3(static_cast<float>(k % 15), 0, static_cast<float>(k / 15)); };
    for (int k = 0; k < 200; ++k) {
      const bool moves = k % 4 == 0, one_body = k % 8 == 0;
      const glm::vec3 a = place(k), b = a + glm::vec3(tolerance * uniform(random, 1.0f, 1.6f), 0, 0);
      if (one_body) {
        state.add({a, b});
      } else {
        state.add({a});
        state.add({b});
      }
      const float most = seed == 1 ? 0.004f : 0.03f;  // tolerances a frame; with the slow ones all are listed at once
      speed.push_back(glm::vec3(moves ? tolerance * uniform(random, 0, most) : 0.0f, 0, 0));
      speed.push_back(glm::vec3(moves ? -tolerance * uniform(random, 0, most) : 0.0f, 0, 0));
    }
    std::size_t first = 0, last = 0;
    for (int frame = 0; frame < 75; ++frame) {  // pauses of 8, 16, 32 and, by now, 64 frames
      see(state);
      (frame == 0 ? first : last) = result_.contacts.size();
      for (std::size_t v = 0; v < speed.size(); ++v) state.x[v] += speed[v].x;
    }
    EXPECT_GE(last, first + 5);
  }
  EXPECT_GT(remembered_, 0u);
  EXPECT_GT(kept_, 0u);
}

/// One backs off within the margin, another comes near it and is listed; then both close in on each other. What counts
/// is how far the first has come since the listing, not since it was noted down.
TEST_P(Memory, MissesNoneThatBackedOffBeforeTheOtherWasListed) {
  constexpr float margin = 0.25f * tolerance;  // the least, since nearly all are at rest
  State state;
  state.tolerance = tolerance;
  for (int k = 0; k < 20; ++k) state.add({glm::vec3(static_cast<float>(k), 5, 0)});
  state.add({glm::vec3(0)});
  state.add({glm::vec3(2 * tolerance, 0, 0)});
  float &a = state.x[20], &b = state.x[21];
  for (int frame = 0; frame < 5; ++frame) see(state);
  a = -0.45f * margin;
  b = a + 1.002f * (tolerance + margin);
  see(state);
  EXPECT_TRUE(result_.contacts.empty());
  a += 0.9f * margin;
  b -= 0.45f * margin;
  see(state);
  EXPECT_EQ(result_.contacts, (std::vector<Contact>{{20, 21}}));
}

/// Where squares underflow or overflow, more is accepted than the true distance would say.
TEST_P(Memory, HoldsAtTheEndsOfTheRange) {
  for (const float size : {1e-22f, 1e-21f, 1e-19f, 1e-17f, 1e15f, 1.2e19f, 1.5e19f}) {
    std::mt19937 random(26);
    State state;
    state.tolerance = size;
    for (int body = 0; body < 60; ++body) state.add(random_points(random, 2, -3 * size, 3 * size));
    for (int frame = 0; frame < 25; ++frame) {
      see(state);
      shake(state, random, 0.02f * size);
    }
  }
  EXPECT_GT(remembered_, 0u);
}

INSTANTIATE_TEST_SUITE_P(Threads, Memory, testing::Values(1, 2, 3, 0), [](const auto& threads) {
  return threads.param == 0 ? std::string("switching") : std::to_string(threads.param);
});

}  // namespace
}  // namespace collide::test
