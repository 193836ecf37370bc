// What the exact method says that it left out.

#include <gtest/gtest.h>

#include "states.h"

namespace collide::test {
namespace THIS_FILE {

/// Spheres of 1 m radius and 162 vertices with the given centres.
State spheres(const std::vector<glm::vec3>& centres) {
  State state;
  const Ball ball = icosphere(2, 1);
  const auto shape = std::make_shared<const Shape>(static_cast<Index>(ball.vertices.size()), ball.edges, ball.vertices);
  for (const glm::vec3& centre : centres) state.add(shape, moved(ball.vertices, centre));
  return state;
}

/// Their boxes and spheres overlap, and a plane separates them.
State parallel_discs() {
  State state;
  std::vector<glm::vec3> disc;
  for (int i = 0; i < 81; ++i) {
    const auto x = static_cast<float>(i % 9 - 4), z = static_cast<float>(i / 9 - 4);
    disc.push_back({x, -x, z});
  }
  state.add(disc);
  state.add(moved(disc, glm::vec3(0.25f, 0.25f, 0)));
  return state;
}

/// 4 cm from pole to pole.
State folded_sphere() {
  State state = spheres({glm::vec3(0)});
  for (float& y : state.y) y *= 0.02f;
  return state;
}

/// Of one of three, two vertices are far from where the rest of the body says: they are tested with all others, and
/// their contact is found from both sides.
State torn_sphere() {
  State state = spheres({glm::vec3(0), glm::vec3(9, 0, 0), glm::vec3(0, 0, 9)});
  for (const Index v : {20u, 40u}) {  // none that the map is fitted to
    state.x[v] = 3;
    state.y[v] = state.z[v] = 0;
  }
  return state;
}

struct Case {
  std::string_view what;
  State state;
  bool self_collision;
  Skipped skipped;  // far pairs, separated pairs, lone bodies, unfolded bodies, kept pairs
  std::uint64_t most_tests = ~std::uint64_t{0};
};

TEST(Skipped, NamesWhatEachSituationLetsTheExactMethodLeaveOut) {
  constexpr std::uint64_t all_tests = 162 * 161 / 2;  // of a sphere
  const std::vector<Case> cases{
      {"no bodies", {}, true, {}},
      {"a lone sphere, which is not worth the proof", spheres({glm::vec3(3)}), true, {0, 0, 1, 0}, all_tests},
      {"without self-collision", spheres({glm::vec3(3)}), false, {0, 0, 1, 0}},
      {"three far spheres",
       spheres({glm::vec3(0), glm::vec3(5, 0, 0), glm::vec3(0, 0, 9)}),
       true,
       {3, 0, 3, 3},
       all_tests / 7},
      {"two whose boxes overlap", spheres({glm::vec3(0), glm::vec3(1.5f)}), true, {0, 1, 2, 0}},
      {"parallel discs", parallel_discs(), false, {0, 1, 0, 0}},
      {"a folded sphere", folded_sphere(), true, {0, 0, 1, 0}},
      {"a torn sphere", torn_sphere(), true, {3, 0, 3, 2}, all_tests / 5},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.what);
    const Settings settings{.self_collision = c.self_collision};
    const Result result = detect("multi-level-sb-exact", c.state, settings);
    EXPECT_EQ(result.skipped, c.skipped);
    EXPECT_LE(result.counters.pair_tests, c.most_tests);
    EXPECT_EQ(result.contacts, oracle(c.state, settings));
  }
}

/// A box that stays the same has its body's positions copied; in the frame after that they are compared.
TEST(Skipped, NamesThePairThatIsKeptOnceBodiesRest) {
  const State state = spheres({glm::vec3(0), glm::vec3(1.9f, 0, 0)});
  const auto detector = find_method("multi-level-sb-exact")->make();
  Workers workers(1);
  Result result;
  for (int frame = 0; frame < 4; ++frame) {
    detector->detect(state.frame(), {}, workers, result);
    EXPECT_EQ(result.skipped, frame < 2 ? (Skipped{0, 0, 0, 0, 0}) : (Skipped{0, 0, 0, 0, 1}));
    EXPECT_GT(result.contacts.size(), 0u);
  }
  EXPECT_EQ(result.counters.pair_tests, 0u);
}

}  // namespace THIS_FILE
}  // namespace collide::test
