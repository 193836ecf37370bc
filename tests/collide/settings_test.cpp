#include <gtest/gtest.h>

#include <cmath>

#include "states.h"

namespace collide::test {
namespace THIS_FILE {

TEST(Settings, HaveNoProblemByDefaultAndAtTheirLimits) {
  Settings settings;
  EXPECT_EQ(problem(settings), "");
  settings.levels = max_levels;
  settings.buckets = max_buckets;
  EXPECT_EQ(problem(settings), "");
  settings.levels = 0;
  settings.buckets = 1;
  settings.cell_size = glm::vec3(1e-45f, 1, 3e38f);
  for (const float tolerance : {min_tolerance, max_tolerance}) {
    settings.tolerance = tolerance;
    EXPECT_EQ(problem(settings), "");
    EXPECT_TRUE(std::isnormal(tolerance * tolerance));
  }
}

TEST(Settings, NameTheProblemAndItsValue) {
  const auto expect_problem = [](const std::string& words, const std::function<void(Settings&)>& change) {
    Settings settings;
    change(settings);
    EXPECT_NE(problem(settings).find(words), std::string::npos) << problem(settings);
  };
  expect_problem("levels is 16; it must be 0 to 15", [](Settings& s) { s.levels = 16; });
  expect_problem("levels is -1; it must be 0 to 15", [](Settings& s) { s.levels = -1; });
  expect_problem("buckets is 0; it must be 1 to 16777216", [](Settings& s) { s.buckets = 0; });
  expect_problem("buckets is 16777217", [](Settings& s) { s.buckets = max_buckets + 1; });
  expect_problem("prime is 0; it must be above 0", [](Settings& s) { s.primes[1] = 0; });
  expect_problem("tolerance is 5e+29; it must be 1e-18 to 1e18 m", [](Settings& s) { s.tolerance = 5e29f; });
  for (const float bad : {0.0f, -1.0f, INFINITY, NAN}) {
    expect_problem("tolerance", [&](Settings& s) { s.tolerance = bad; });
    expect_problem("cell size", [&](Settings& s) { s.cell_size = glm::vec3(1, bad, 1); });
  }
  for (const float beyond : {std::nextafter(min_tolerance, 0.0f), std::nextafter(max_tolerance, INFINITY)})
    expect_problem("tolerance", [&](Settings& s) { s.tolerance = beyond; });
}

TEST(HashWarning, NamesPrimesThatLoseOrMixAxes) {
  Settings settings;
  EXPECT_EQ(hash_warning(settings), "");
  settings.buckets = 101;
  EXPECT_EQ(hash_warning(settings), "");
  settings.primes = {7, 11, 112};
  EXPECT_EQ(hash_warning(settings), "primes 11 and 112 are equal modulo 101 buckets, so two axes are mixed");
  settings.primes = {7, 202, 5};
  EXPECT_EQ(hash_warning(settings), "prime 202 is 0 modulo 101 buckets, so its axis is lost");
  settings.buckets = 1;
  EXPECT_NE(hash_warning(settings).find("; "), std::string::npos);
}

TEST(AutomaticCellSize, IsTheLargestBoxPlusTheTolerance) {
  State state;
  state.add({glm::vec3(0), glm::vec3(1, 2, 4)});
  state.add({glm::vec3(10), glm::vec3(13, 11, 11)});
  state.add({glm::vec3(0), glm::vec3(NAN, 100, 100)});
  EXPECT_EQ(automatic_cell_size(state.frame(), 0, 0.5f), glm::vec3(3.5f, 2.5f, 4.5f));
  EXPECT_EQ(automatic_cell_size(state.frame(), 1, 0.5f), glm::vec3(2.0f, 2.5f, 4.5f));
  EXPECT_EQ(automatic_cell_size(state.frame(), 3, 0.5f), glm::vec3(2.0f, 1.5f, 2.5f));
  EXPECT_EQ(automatic_cell_size(state.frame(), 9, 0.5f), glm::vec3(0.875f, 0.75f, 1.0f));
}

TEST(AutomaticCellSize, IsThatAtRestOfBodiesThatKnowIt) {
  Bodies bodies;
  const std::vector<glm::vec3> rest{glm::vec3(0), glm::vec3(4, 1, 1)};
  bodies.add(std::make_shared<Shape>(2, std::span<const std::array<Index, 2>>{}, rest));
  bodies.add(std::make_shared<Shape>(2, std::span<const std::array<Index, 2>>{}));
  const std::vector<float> at{0, 8, 0, 2};
  EXPECT_EQ(automatic_cell_size({at, at, at, &bodies}, 0, 0.5f), glm::vec3(4.5f, 2.5f, 2.5f));
}

TEST(AutomaticCellSize, IsAllowedAndCoversOnEveryState) {
  for (const NamedState& named : named_states()) {
    const State state = named.make();
    for (int levels = 0; levels <= max_levels; ++levels) {
      const Settings settings{.tolerance = state.tolerance,
                              .levels = levels,
                              .cell_size = automatic_cell_size(state.frame(), levels, state.tolerance)};
      EXPECT_EQ(problem(settings), "") << named.name;
      if (named.name.find("scattered") == 0 || named.name.find("toler") != std::string::npos) continue;  // beyond float
      EXPECT_EQ(detect("multi-level-sb", state, settings).coverage, Coverage::covered) << named.name << levels;
    }
  }
}

}  // namespace THIS_FILE
}  // namespace collide::test
