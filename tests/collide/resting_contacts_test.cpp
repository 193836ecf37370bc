// Frames one after another through one detector, which keeps the contacts of bodies at rest, against the oracle frame
// by frame.

#include <gtest/gtest.h>

#include <cmath>

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

/// One exact detector that sees frame after frame, on a fixed number of threads or on another one each time (0).
class KeptContacts : public testing::TestWithParam<int> {
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

/// Two vertices exactly a tolerance apart are no contact; one unit in the last place nearer they are.
TEST_P(KeptContacts, SeeOneVertexMoveByItsLastBit) {
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

/// Now and then a body jumps, flies past the others, loses a coordinate, or all are again where they were.
TEST_P(KeptContacts, AreRightWhileBodiesJumpAndReturn) {
  const State start = pile(3);
  State state = start;
  std::mt19937 random(23);
  for (int frame = 0; frame < 120; ++frame) {
    see(state);
    const Index body = random() % state.bodies.count();
    if (frame % 4 == 3) shift(state, body, random_points(random, 1, -1, 1)[0]);
    if (frame % 16 == 7) state.y[state.bodies.first[body] + 7] = random() % 2 == 0 ? NAN : INFINITY;
    if (frame % 16 == 15) state = start;
    if (frame > 100) shift(state, 0, glm::vec3(0.25f, 0.01f, 0));
    EXPECT_TRUE(frame < 8 || frame % 4 != 2 || result_.skip(Skip::kept_pairs) > 0) << frame;
  }
}

TEST_P(KeptContacts, AreDroppedWithOtherBodiesOrShapes) {
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
  const State fewer = state;
  state.add(other_shape, moved(icosphere(1, 0.5f).vertices, glm::vec3(0.4f)));
  rest("one more");
  state = fewer;
  rest("one less");
}

TEST_P(KeptContacts, FollowTheSettings) {
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
TEST_P(KeptContacts, LoseThoseOfABodyThatLeft) {
  State state;
  state.tolerance = 0.25f;
  for (const float x : {0.0f, 0.2f, -0.2f}) state.add({glm::vec3(x, 0, 0)});
  for (int frame = 0; frame < 4; ++frame) see(state);
  EXPECT_EQ(result_.skip(Skip::kept_pairs), 2u);
  state.x[2] = 50;
  see(state);
  EXPECT_EQ(result_.contacts, (std::vector<Contact>{{0, 1}}));
}

/// A body whose box stays the same while one of its vertices moves along an axis has moved.
TEST_P(KeptContacts, SeeWhatMovesWithinItsBox) {
  State state;
  state.tolerance = 0.25f;
  state.add({glm::vec3(-1), glm::vec3(1), glm::vec3(0)});
  state.add({glm::vec3(0.1f)});
  for (std::vector<float>* coordinate : {&state.x, &state.y, &state.z}) {
    for (int frame = 0; frame < 12; ++frame) {
      (*coordinate)[2] = frame % 3 == 2 ? -0.5f : 0.0f;
      see(state);
      EXPECT_EQ(result_.contacts.size(), frame % 3 == 2 ? 0u : 1u);
    }
    (*coordinate)[2] = 0;
  }
}

TEST_P(KeptContacts, AreNoneAfterForget) {
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
TEST(RestingContacts, AreNoneAfterAFrameThatWasNotStored) {
  const State state = pile(2);
  const Frame frame = state.frame();
  Workers workers(1);
  const Settings settings{.tolerance = state.tolerance};
  BodyPairSearch search;
  RestingContacts resting;
  std::vector<Index> non_finite;
  const auto kept = [&](bool stored) {
    search.find_bounds(frame, workers, non_finite);
    resting.observe(frame, settings, search.bounds(), workers);
    search.find(frame, settings, resting, workers);
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

INSTANTIATE_TEST_SUITE_P(Threads, KeptContacts, testing::Values(1, 2, 3, 0), [](const auto& threads) {
  return threads.param == 0 ? std::string("switching") : std::to_string(threads.param);
});

}  // namespace THIS_FILE
}  // namespace collide::test
