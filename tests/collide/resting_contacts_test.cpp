// Frames one after another through one detector, which keeps the contacts of bodies at rest, against the oracle frame
// by frame.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "collide/exact/body_pair_search.h"
#include "states.h"

namespace collide::test {

using namespace collide::exact;
namespace THIS_FILE {

constexpr float tolerance = 0.1f;

/// Spheres that press on each other in a cube of `side` by `side` by `side`.
State pile(int side, bool crumpled = false) {
  State state;
  std::mt19937 random(21);
  const Ball ball = icosphere(1, 0.5f);
  const auto shape = std::make_shared<const Shape>(static_cast<Index>(ball.vertices.size()), ball.edges, ball.vertices);
  for (int i = 0; i < side * side * side; ++i) {
    std::vector<glm::vec3> vertices = ball.vertices;
    for (glm::vec3& v : vertices) {
      if (crumpled) v = glm::vec3(v.x, 0.15f * v.y + uniform(random, -0.03f, 0.03f), v.z);
    }
    const glm::vec3 cell(static_cast<float>(i % side), static_cast<float>(i / side % side) * (crumpled ? 0.3f : 1.0f),
                         static_cast<float>(i / side / side));
    state.add(shape, moved(vertices, 0.93f * cell + random_points(random, 1, -0.02f, 0.02f)[0]));
  }
  state.tolerance = tolerance;
  return state;
}

void shift(State& state, Index body, const glm::vec3& by) {
  for (Index v = state.bodies.first[body]; v < state.bodies.first[body + 1]; ++v) {
    state.x[v] += by.x;
    state.y[v] += by.y;
    state.z[v] += by.z;
  }
}

/// Moves every vertex by up to `step` along each axis.
void shake(State& state, std::mt19937& random, float step) {
  for (auto* coordinate : {&state.x, &state.y, &state.z}) {
    for (float& value : *coordinate) value += uniform(random, -step, step);
  }
}

/// One exact detector that sees frame after frame, on a fixed number of threads or on another one each time (0).
class RestingContactsKept : public testing::TestWithParam<int> {
 protected:
  void see(const State& state, const char* what = "") {
    settings_.tolerance = state.tolerance;
    const std::vector<Contact> expected = oracle(state, settings_);
    const int threads = GetParam();
    Workers& workers = workers_[static_cast<std::size_t>(threads > 0 ? threads - 1 : frame_ * 7 % 5 % 3)];
    detector_->detect(state.frame(), settings_, workers, result_);
    ++frame_;
    ASSERT_EQ(result_.contacts, expected) << what << " frame " << frame_;
    ASSERT_EQ(result_.self_contacts, inside_bodies(state, expected).size()) << what << " frame " << frame_;
    kept_ += result_.skip(Skip::kept_pairs);
  }

  Settings settings_;
  Result result_;
  std::uint64_t kept_ = 0;
  int frame_ = 0;
  std::unique_ptr<Detector> detector_ = find_method("multi-level-sb-exact")->make();
  std::array<Workers, 3> workers_{Workers(1), Workers(2, 0), Workers(3, 0)};
};

TEST_P(RestingContactsKept, AreNoneInASlowDrift) {
  State state = pile(3);
  std::mt19937 random(22);
  const std::vector<glm::vec3> speed =
      random_points(random, state.bodies.count(), -0.03f * tolerance, 0.03f * tolerance);
  for (int frame = 0; frame < 40; ++frame) {
    see(state);
    for (Index body = 0; body < state.bodies.count(); ++body) shift(state, body, speed[body]);
    shake(state, random, 0.002f * tolerance);
  }
  EXPECT_EQ(kept_, 0u);
}

TEST_P(RestingContactsKept, FollowsOneThatFliesPastAPileAtRest) {
  State state = pile(3);
  state.add(state.bodies.shape[0], moved(icosphere(1, 0.5f).vertices, glm::vec3(-3, 2.6f, 1)));
  for (int frame = 0; frame < 30; ++frame) {
    see(state);
    if (frame < 24) shift(state, state.bodies.count() - 1, glm::vec3(0.25f, -0.01f, 0));
  }
  EXPECT_GT(kept_, 0u);
}

/// Two vertices exactly a tolerance apart are no contact; one unit in the last place nearer they are.
TEST_P(RestingContactsKept, SeesABodyAtRestThatIsNudgedByOneUlp) {
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
  EXPECT_EQ(result_.skip(Skip::kept_pairs), at_rest) << "it rests where it lies now";
  state.x.back() = 8.25f;
  see(state);
  EXPECT_EQ(result_.contacts.size(), before);
}

TEST_P(RestingContactsKept, SeesOneThatLeavesAndReturnsToTheBit) {
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

TEST_P(RestingContactsKept, SeesJumps) {
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

TEST_P(RestingContactsKept, LeavesOutABodyWhileItIsNotFinite) {
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
      EXPECT_GT(result_.skip(Skip::kept_pairs), 0u) << "those of the others";
      for (int frame = 0; frame < 4; ++frame) see(state, "after");
      EXPECT_TRUE(result_.non_finite_bodies.empty());
    }
  }
  EXPECT_GT(kept_, 0u);
}

TEST_P(RestingContactsKept, ForgetsWhenBodiesOrShapesAreOthers) {
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

TEST_P(RestingContactsKept, FollowsRandomWalksOfAnyStep) {
  for (const float step : {1e-4f, 1e-3f, 0.01f, 0.03f, 0.06f, 0.1f, 0.2f, 0.5f, 1.0f, 3.0f, 10.0f}) {  // tolerances
    State state = pile(2);
    std::mt19937 random(24);
    for (int frame = 0; frame < 25; ++frame) {
      see(state);
      for (Index body = 0; body < state.bodies.count(); ++body) {
        shift(state, body, random_points(random, 1, -step * tolerance, step * tolerance)[0]);
      }
      shake(state, random, 0.1f * step * tolerance);
    }
  }
}

TEST_P(RestingContactsKept, FollowsSelfContacts) {
  State state = pile(2, true);
  std::mt19937 random(25);
  std::uint64_t self = 0;
  for (int frame = 0; frame < 30; ++frame) {
    see(state);
    self += result_.self_contacts;
    shake(state, random, 0.03f * tolerance);
  }
  EXPECT_GT(self, 1000u);
}

/// Where squares underflow or overflow, more is accepted than the true distance would say.
TEST_P(RestingContactsKept, HoldsAtTheEndsOfTheRange) {
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
}

TEST_P(RestingContactsKept, FollowTheSettings) {
  State state = pile(2, true);
  for (const float other : {0.1f, 0.05f, 0.13f}) {
    for (const bool self : {true, false}) {
      for (const int levels : {3, 0, 15}) {
        state.tolerance = other;
        settings_.self_collision = self;
        settings_.levels = levels;
        for (int frame = 0; frame < 4; ++frame) see(state);
        EXPECT_GT(result_.skip(Skip::kept_pairs), 0u);
      }
    }
  }
}

/// What two bodies keep must not outlast a visitor of theirs, though neither of the two has moved.
TEST_P(RestingContactsKept, LoseThoseOfABodyThatLeft) {
  State state;
  state.tolerance = 0.25f;
  for (const float x : {0.0f, 0.2f, -0.2f}) state.add({glm::vec3(x, 0, 0)});
  for (int frame = 0; frame < 4; ++frame) see(state);
  EXPECT_EQ(result_.skip(Skip::kept_pairs), 2u);
  state.x[2] = 50;
  see(state);
  EXPECT_EQ(result_.contacts, (std::vector<Contact>{{0, 1}}));
}

/// A body whose box stays the same while it turns inside it has moved.
TEST_P(RestingContactsKept, SeeWhatMovesWithinItsBox) {
  State state;
  state.tolerance = 0.25f;
  state.add({glm::vec3(-1), glm::vec3(1), glm::vec3(0)});
  state.add({glm::vec3(0.2f, 0, 0)});
  for (int frame = 0; frame < 12; ++frame) {
    state.y[2] = frame % 3 == 2 ? 0.5f : 0.0f;
    see(state);
    EXPECT_EQ(result_.contacts.size(), frame % 3 == 2 ? 0u : 1u);
  }
}

TEST_P(RestingContactsKept, AreNoneOnceToldToForget) {
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

/// As after a frame that ended in an error: what is stored is older than the positions that are compared with.
TEST(RestingContacts, KeepsNothingOverAFrameThatWasNotStored) {
  const State state = pile(2);
  const Frame frame = state.frame();
  Workers workers(1);
  Settings settings;
  settings.tolerance = state.tolerance;
  BodyPairSearch search;
  RestingContacts resting;
  std::vector<Index> non_finite;
  const auto kept = [&](bool stored) {
    search.find_bounds(frame, workers, non_finite);
    resting.observe(frame, settings, search.bounds(), workers);
    search.find(frame, {settings.tolerance, true, 3, 1000}, resting, workers);
    const bool any = resting.group(0, search.near()).has_value();
    std::vector<Contact> contacts;
    search.concatenate(workers, contacts);
    if (stored) resting.store(frame, search.near(), contacts);
    return any;
  };
  EXPECT_FALSE(kept(true));
  EXPECT_FALSE(kept(true));
  EXPECT_TRUE(kept(true));
  EXPECT_TRUE(kept(false));
  EXPECT_FALSE(kept(true));
  EXPECT_TRUE(kept(true));
}

INSTANTIATE_TEST_SUITE_P(Threads, RestingContactsKept, testing::Values(1, 2, 3, 0), [](const auto& threads) {
  return threads.param == 0 ? std::string("switching") : std::to_string(threads.param);
});

}  // namespace THIS_FILE
}  // namespace collide::test
