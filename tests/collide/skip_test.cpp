// What the exact method says that it left out, in situations that say themselves what can be.

#include <gtest/gtest.h>

#include "states.h"

namespace collide::test {
namespace THIS_FILE {

constexpr const char* exact = "multi-level-sb-exact";

Skipped skipped(std::uint64_t far, std::uint64_t separated, std::uint64_t lone, std::uint64_t unfolded,
                std::uint64_t kept = 0) {
  return {far, separated, lone, unfolded, kept};
}

/// Spheres of 1 m radius with the given centres.
State spheres(const std::vector<glm::vec3>& centres) {
  State state;
  const Ball ball = icosphere(2, 1);
  const auto shape = std::make_shared<const Shape>(static_cast<Index>(ball.vertices.size()), ball.edges, ball.vertices);
  for (const glm::vec3& centre : centres) state.add(shape, moved(ball.vertices, centre));
  return state;
}

TEST(Skipped, OfNoBodiesIsNothing) {
  EXPECT_EQ(detect(exact, State{}, {}).skipped, skipped(0, 0, 0, 0));
  State state;
  state.add({});
  EXPECT_EQ(detect(exact, state, {}).skipped, skipped(0, 0, 0, 0));
}

TEST(Skipped, OfALoneSphereAreBothPasses) {
  const Result result = detect(exact, spheres({glm::vec3(3)}), {});
  EXPECT_EQ(result.skipped, skipped(0, 0, 1, 1));
  EXPECT_LT(result.counters.pair_tests, 162u * 161 / 2 / 20);
  Settings settings;
  settings.self_collision = false;
  EXPECT_EQ(detect(exact, spheres({glm::vec3(3)}), settings).skipped, skipped(0, 0, 1, 0));
}

TEST(Skipped, OfThreeFarSpheresAreAllPairs) {
  EXPECT_EQ(detect(exact, spheres({glm::vec3(0), glm::vec3(5, 0, 0), glm::vec3(0, 0, 9)}), {}).skipped,
            skipped(3, 0, 3, 3));
}

TEST(Skipped, OfSpheresCornerToCornerIsThePair) {  // their boxes overlap, but they are 2.6 m apart
  EXPECT_EQ(detect(exact, spheres({glm::vec3(0), glm::vec3(1.5f)}), {}).skipped, skipped(0, 1, 2, 2));
}

TEST(Skipped, OfParallelDiscsIsThePair) {  // boxes and spheres overlap; a plane between the discs parts them
  State state;
  std::vector<glm::vec3> disc;
  for (int i = 0; i < 81; ++i) {
    const auto x = static_cast<float>(i % 9 - 4), z = static_cast<float>(i / 9 - 4);
    disc.push_back({x, -x, z});
  }
  state.add(disc);
  state.add(moved(disc, glm::vec3(0.25f, 0.25f, 0)));
  Settings settings;
  settings.self_collision = false;
  EXPECT_EQ(detect(exact, state, settings).skipped, skipped(0, 1, 0, 0));
}

TEST(Skipped, OfAFoldedSphereIsNothing) {
  State state = spheres({glm::vec3(0)});
  for (float& y : state.y) y *= 0.02f;  // 4 cm from pole to pole
  const Result result = detect(exact, state, {});
  EXPECT_EQ(result.skipped, skipped(0, 0, 1, 0));
  EXPECT_GT(result.self_contacts, 0u);
}

/// Two vertices that are far from where the rest of the body says are tested with all others: their contact is found
/// from both sides, and is one.
TEST(Skipped, OfATornSphereIsAllButTheOddVertices) {
  State state = spheres({glm::vec3(0)});
  for (const Index v : {20u, 40u}) {  // none that the map is fitted to
    state.x[v] = 3;
    state.y[v] = state.z[v] = 0;
  }
  const Result result = detect(exact, state, {});
  EXPECT_EQ(result.skipped, skipped(0, 0, 1, 0));
  EXPECT_EQ(result.contacts, (std::vector<Contact>{{20, 40}}));
  EXPECT_LT(result.counters.pair_tests, 162u * 161 / 2 / 10);
}

/// A box that stays the same has its body's positions copied; in the frame after that they are compared.
TEST(Skipped, OfBodiesAtRestBecomesThePairThatIsKept) {
  const State state = spheres({glm::vec3(0), glm::vec3(1.9f, 0, 0)});
  const auto detector = find_method(exact)->make();
  Workers workers(1);
  Result result;
  const std::array expected{skipped(0, 0, 0, 2), skipped(0, 0, 0, 2), skipped(0, 0, 0, 0, 1), skipped(0, 0, 0, 0, 1)};
  for (const Skipped& frame : expected) {
    detector->detect(state.frame(), {}, workers, result);
    EXPECT_EQ(result.skipped, frame);
    EXPECT_GT(result.contacts.size(), 0u);
  }
  EXPECT_EQ(result.counters.pair_tests, 0u);
}

}  // namespace THIS_FILE
}  // namespace collide::test
