// What `report solver` reads from errors, on made-up ones: the order of a method, and why its curve ends.

#include <gtest/gtest.h>

#include "app/report/solver/results.h"

namespace app::test {
namespace THIS_FILE {

constexpr double bound = 2e-5;  // R

/// Returns the order of a curve with these errors at 1, 2, 4 ... steps. An error of 0 means that it blew up.
std::optional<double> order(const std::vector<double>& errors, bool at_rest = false) {
  const report::SolverCase c{.scene = {.key = "ball", .name = "Ball", .at_rest = at_rest},
                             .reference = {{.change = 1e-6}}};
  report::WorkCurve curve{nullptr};
  int steps = 1;
  for (const double e : errors) {
    curve.points.push_back({.substeps = steps, .blew_up = e <= 0, .error = e});
    steps *= 2;
  }
  return c.order(curve, bound);
}

TEST(SolverCaseOrder, IsTheMedianSlopeOfTheLongestRowOfFallingErrors) {
  struct Case {
    const char* what;
    std::vector<double> errors;
    double order;
  };
  for (const auto& [what, errors, expected] :
       std::vector<Case>{{"a straight line", {1.6e-1, 4e-2, 1e-2, 2.5e-3}, 2},
                         {"after two that blew up", {0, 0, 8e-3, 4e-3, 2e-3}, 1},
                         {"of two the mean", {1.6e-1, 8e-2, 2e-2}, 1.5},
                         {"of 1, 2, 3, 1 the mean of the middle two", {1.28e-1, 6.4e-2, 1.6e-2, 2e-3, 1e-3}, 1.5},
                         {"of two rows the one with more steps", {1.6e-1, 4e-2, 1e-2, 1.1e-2, 5.5e-3, 2.75e-3}, 1},
                         {"the longer row", {1.6e-1, 4e-2, 1e-2, 2.5e-3, 2.4e-3, 1.2e-3, 6e-4}, 2},
                         {"not of coarse errors", {5, 1.6e-1, 4e-2, 1e-2}, 2},
                         {"not of small falls", {9e-4, 7.5e-4, 1e-3, 1.6e-3, 4e-4, 1e-4}, 2},
                         {"not of rounding", {1.6e-2, 4e-3, 1e-3, 1.1e-3, 7e-4}, 2},
                         {"of one fall that reaches the uncertainty", {0, 0, 1.6e-4, 1e-5}, 4}})
    EXPECT_NEAR(order(errors).value_or(0), expected, 1e-9) << what;
}

TEST(SolverCaseOrder, IsNothingIfErrorsDoNotFallOrNothingMoves) {
  for (const std::vector<double>& errors :
       {std::vector<double>{}, {0, 0}, {1.1e-4, 5.6e-5, 1.2e-4}, {1.9, 1.8, 1.5, 1.4}, {8e-5, 9e-5, 9.5e-5, 1.9e-4}})
    EXPECT_EQ(order(errors), std::nullopt) << testing::PrintToString(errors);
  EXPECT_EQ(order({1.6e-1, 4e-2, 1e-2, 2.5e-3}, true), std::nullopt);
}

/// Returns a case in which `auto` and semi-implicit Euler have these errors (R) with their own steps.
report::SolverCase with_own_errors(double of_auto, double of_semi_implicit) {
  report::SolverCase c{.scene = {.key = "ball", .name = "Ball", .promised = 0.01}, .reference = {}};
  for (const auto& [key, error] : {std::pair("auto", of_auto), std::pair("semi-implicit-euler", of_semi_implicit)}) {
    const report::WorkPoint own{.error = error};
    c.curves.push_back({softbody::find_integrator(key), {own}, own});
  }
  return c;
}

TEST(SolverCasePromise, IsTheBoundOrTwiceTheErrorOfSemiImplicitEuler) {
  EXPECT_TRUE(with_own_errors(0.01, 1e-3).keeps_promise());
  EXPECT_FALSE(with_own_errors(0.011, 1e-3).keeps_promise());
  EXPECT_TRUE(with_own_errors(0.04, 0.02).keeps_promise());
  EXPECT_FALSE(with_own_errors(0.041, 0.02).keeps_promise());
  report::SolverCase c = with_own_errors(0, 0);
  c.curves[1].own->blew_up = true;
  EXPECT_DOUBLE_EQ(c.allowed(), 0.01);
  c.curves[0].own->blew_up = true;
  EXPECT_FALSE(c.keeps_promise()) << "it blew up";
}

TEST(SolverPage, ShowsWhetherThePromiseIsKept) {
  report::SolverResults r;
  r.options.name = "solver";
  r.cases.push_back(with_own_errors(0.004, 1e-3));
  EXPECT_NE(report::solver_page(r).markdown(false).find("| kept |"), std::string::npos);
  r.cases.push_back(with_own_errors(0.02, 1e-3));
  EXPECT_NE(report::solver_page(r).markdown(false).find("| MISSED |"), std::string::npos);
}

/// Returns what the page says about curves that end early. Each has one point, with so many steps.
std::string left_out(const std::vector<int>& ends) {
  report::SolverResults r;
  r.options.name = "solver";
  r.effort = {.seconds = 0.5, .max_substeps = 64, .bound = bound};
  report::SolverCase& c = r.cases.emplace_back(with_own_errors(1e-6, 1e-6));
  for (const int n : ends)
    c.curves.push_back({softbody::find_integrator("rk4"), {{.substeps = n, .error = n == 1 ? 1e-6 : 1e-2}}});
  const std::string text = report::solver_page(r).markdown(false);
  const std::size_t at = text.find("Left out");
  return at == std::string::npos ? "" : text.substr(at, text.find("With the fewest") - at);
}

TEST(SolverPage, SaysWhyCurvesEnd) {
  const std::string known = "Left out, above the reference's uncertainty of 2e-05 R, since ";
  const std::string long_runs = known + "runs took longer than 0.5 s: Runge-Kutta 4 beyond 16 steps per frame.\n\n";
  const std::string most = known + "no more steps were tried: Runge-Kutta 4 beyond 64 steps per frame.\n\n";
  EXPECT_EQ(left_out({16, 1}), long_runs);
  EXPECT_EQ(left_out({1, 64}), most);
  EXPECT_EQ(left_out({64, 16}), long_runs + most);
  EXPECT_EQ(left_out({1}), "");
}

}  // namespace THIS_FILE
}  // namespace app::test
