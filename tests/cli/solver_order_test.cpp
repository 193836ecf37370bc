// The order of a method that `report solver` reads from errors, on made-up ones.

#include <gtest/gtest.h>

#include "app/report/solver/results.h"

namespace app::test {
namespace {

constexpr double bound = 2e-5;  // R

/// With 1, 2, 4 ... steps; an error of 0 blew up.
std::optional<double> order(const std::vector<double>& errors, bool at_rest = false) {
  const SolverCase c{.key = "ball", .name = "Ball", .at_rest = at_rest, .reference = "", .change = 1e-6};
  WorkCurve curve{nullptr};
  int steps = 1;
  for (const double e : errors) {
    curve.points.push_back({.substeps = steps, .blew_up = e <= 0, .error = e});
    steps *= 2;
  }
  return c.order(curve, bound);
}

TEST(SolverOrder, IsThatOfFallingErrors) {
  EXPECT_NEAR(order({1.6e-1, 4e-2, 1e-2, 2.5e-3}).value_or(0), 2, 1e-9);
  EXPECT_NEAR(order({0, 0, 8e-3, 4e-3, 2e-3}).value_or(0), 1, 1e-9);
}

TEST(SolverOrder, LeavesOutWhatIsTooCoarseAndRounding) {
  EXPECT_NEAR(order({5, 1.6e-1, 4e-2, 1e-2}).value_or(0), 2, 1e-9);
  EXPECT_NEAR(order({9e-4, 7.5e-4, 1e-3, 1.6e-3, 4e-4, 1e-4}).value_or(0), 2, 1e-9);
  EXPECT_NEAR(order({1.6e-2, 4e-3, 1e-3, 1.1e-3, 7e-4}).value_or(0), 2, 1e-9);
}

TEST(SolverOrder, OneStepTellsItOnlyIfItComesAsFarAsTheReferenceIsKnown) {
  EXPECT_EQ(order({1.1e-4, 5.6e-5, 1.2e-4}), std::nullopt);
  EXPECT_NEAR(order({0, 0, 1.6e-4, 1e-5}).value_or(0), 4, 1e-9);
}

TEST(SolverOrder, IsNoneWhereErrorsDoNotFallAndWhereNothingMoves) {
  EXPECT_EQ(order({}), std::nullopt);
  EXPECT_EQ(order({0, 0}), std::nullopt);
  EXPECT_EQ(order({1.9, 1.8, 1.5, 1.4}), std::nullopt);
  EXPECT_EQ(order({8e-5, 9e-5, 9.5e-5, 1.9e-4}), std::nullopt);
  EXPECT_EQ(order({1.6e-1, 4e-2, 1e-2, 2.5e-3}, true), std::nullopt);
}

}  // namespace
}  // namespace app::test
