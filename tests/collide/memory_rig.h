#pragma once
// Frames one after another through one detector, so that it remembers, against the oracle frame by frame.

#include <gtest/gtest.h>

#include "states.h"

namespace collide::test {

constexpr float tolerance = 0.1f;

/// Spheres that press on each other in a cube of `side` by `side` by `side`.
inline State pile(int side, bool crumpled = false) {
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

inline void shift(State& state, Index body, const glm::vec3& by) {
  for (Index v = state.bodies.first[body]; v < state.bodies.first[body + 1]; ++v) {
    state.x[v] += by.x;
    state.y[v] += by.y;
    state.z[v] += by.z;
  }
}

/// Moves every vertex by up to `step` along each axis.
inline void shake(State& state, std::mt19937& random, float step) {
  for (auto* coordinate : {&state.x, &state.y, &state.z}) {
    for (float& value : *coordinate) value += uniform(random, -step, step);
  }
}

/// One detector that sees the frames, on a fixed number of threads or on another one each time (0).
class Memory : public testing::TestWithParam<int> {
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
    remembered_ += result_.skip(Skip::remembered_pairs);
    kept_ += result_.skip(Skip::kept_pairs);
  }

  Settings settings_;
  Result result_;
  std::uint64_t remembered_ = 0, kept_ = 0;
  int frame_ = 0;
  std::unique_ptr<Detector> detector_ = find_method("multi-level-sb-exact")->make();
  std::array<Workers, 3> workers_{Workers(1), Workers(2), Workers(3)};
};

}  // namespace collide::test
