// `report theory`: its closed forms, and the files of the quick report.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "app/report/theory/closed_forms.h"
#include "app/report/theory/results.h"
#include "softbody/integrate/integrators.h"
#include "tests/cli/report_rig.h"

namespace cli::test {
namespace THIS_FILE {

using namespace app::report::closed_form;

TEST(ClosedForm, OfAStepTurnsAsTheSwingDoesIfStepsAreShort) {
  for (const char* key : {"explicit-euler", "semi-implicit-euler", "velocity-verlet", "rk4"}) {
    EXPECT_LT(std::abs(stepped(key, 1e-5, 1e5) - std::polar(1.0, 1.0)), 1e-4) << key;
    EXPECT_NEAR(stepped_frequency(key, 3, 1e-5), 3, 1e-6) << key;
  }
  EXPECT_NEAR(std::abs(stepped("velocity-verlet", 1.5, 777)), 1, 1e-9);
  EXPECT_NEAR(stepped("semi-implicit-euler", 0.5, 1).real(), 1 - 0.5 * 0.5, 1e-12) << "x - h^2 omega^2 x";
}

TEST(ClosedForm, OfAShellHasThePublishedFrequencyAndLimit) {
  EXPECT_NEAR((ShellMode{2}.frequency(300, 4)), 0.442 * std::sqrt(300.0 / 4), 0.002);
  EXPECT_NEAR((ShellMode{1000}.square()), 1, 1e-5) << "waves along a meridian";
}

TEST(ClosedForm, OfBreathingIsTheSlopeOfTheForceAtBalance) {
  const double k = 700, m = 3, rest = 0.4, P0 = 4'000, outside = 900;
  const auto pressure = [&](double R) { return P0 * std::pow(rest / R, 3); };
  const auto force = [&](double R) {
    return 4 * pi * R * R * (pressure(R) - outside) - 8 * pi * std::sqrt(3.0) * k * (R - rest);
  };
  double inside = rest, beyond = 2 * rest;
  for (int i = 0; i < 60; ++i) {
    const double R = (inside + beyond) / 2;
    (force(R) > 0 ? inside : beyond) = R;
  }
  const double slope = (force(inside + 1e-6) - force(inside - 1e-6)) / 2e-6;
  const double expected = std::sqrt(-slope / m) / (2 * pi), P = pressure(inside);
  EXPECT_NEAR(breathing_frequency(k, m, inside, P, P - outside), expected, 1e-6 * expected);
}

TEST(ClosedForm, OfAChainIsAParabolaIfItHardlySags) {
  EXPECT_NEAR(catenary_sag(2.0002, 2), std::sqrt(3.0 / 8 * 2 * 0.0002), 1e-5);
  EXPECT_NEAR(catenary_sag(200, 2), 100, 5) << "m: nearly straight down";
}

TEST(ClosedForm, OfFlipsIsThatOfEulersEquations) {
  const glm::dvec3 I(1, 1.4, 2);
  for (const glm::dvec3& start : {glm::dvec3(0.1, 3, 0.2), glm::dvec3(0.3, 3, 0.05)}) {
    glm::dvec3 w = start;
    const auto rate = [&](const glm::dvec3& at) { return -glm::cross(at, I * at) / I; };
    std::vector<double> flips;
    constexpr double h = 1e-4;
    for (double t = 0; flips.size() < 2; t += h) {
      const double before = w.y;
      const glm::dvec3 middle = w + h / 2 * rate(w);
      w += h * rate(middle);
      if ((before > 0) != (w.y > 0)) flips.push_back(t);
    }
    EXPECT_NEAR(flip_time(I, start), flips[1] - flips[0], 1e-3);
  }
}

/// Returns rows of a case with two variants: by two integrators, the first with twice the steps, too.
std::vector<app::report::TheoryRow> rows_of(const app::report::TheoryCase& of) {
  std::vector<app::report::TheoryRow> rows;
  for (const softbody::Integrator& i : softbody::integrators().first(2))
    for (const auto& [variant, finer] : {std::pair(0, 1), {0, 2}, {1, 1}})
      rows.push_back({{.theory = 1, .measured = 2.0 + variant}, &of, &i, variant, finer, 60.0 * finer});
  return rows;
}

app::report::Page page_of(const std::vector<app::report::TheoryRow>& rows) {
  app::report::ReportOptions options;
  options.name = "theory";
  return theory_page(options, rows);
}

TEST(TheoryPage, JoinsRunsOfOneVariantInTheIntegratorsColour) {
  const app::report::TheoryCase bounce{"bounce", "Bounce", {"e = 0.5", "e = 1"}, false, nullptr};
  std::vector<app::report::TheoryRow> rows = rows_of(bounce);
  const auto plot = [&] { return page_of(rows).plots().at(0); };
  const app::report::Plot both = plot();
  ASSERT_EQ(both.series.size(), 4u);
  for (const app::report::Series& series : both.series)
    for (const app::report::Point& p : series.points) EXPECT_EQ(p.y, series.points[0].y) << "of another variant";
  EXPECT_EQ(both.series[0].colour, both.series[1].colour);
  EXPECT_NE(both.series[0].colour, both.series[2].colour);
  EXPECT_NE(both.caption.find("squares: e = 1"), std::string::npos) << both.caption;
  for (int i = 0; i < 3; ++i) rows[std::size_t(i)].rate = 0;  // was not run
  EXPECT_EQ(plot().series.at(0).colour, both.series[2].colour);
}

TEST(TheoryPage, WritesAHundredPercentWithoutAnExponent) {
  const app::report::TheoryCase bounce{"bounce", "Bounce", {"e = 0.5", "e = 1"}, false, nullptr};
  const std::string text = page_of(rows_of(bounce)).markdown(false);
  EXPECT_NE(text.find("| 100 % | 100 % | 200 % |"), std::string::npos) << text;
}

TEST(TheoryReport, ComparesEachIntegratorIfQuick) {
  const TemporaryFolder folder;
  const auto out = folder.path() / "out";
  const Outcome o = run({"report", "theory", "--quick", "--out", out});
  ASSERT_EQ(o.status, 0) << o.err;
  const std::string csv = read_file(out / "theory.csv");
  EXPECT_EQ(csv.substr(0, csv.find('\n')), "case,integrator,setting,theory,measured,error,ms");
  std::map<std::string, std::set<std::string>> integrators;
  for (Row& row : read_csv(out / "theory.csv")) {
    integrators[row["case"]].insert(row["integrator"]);
    if (row["case"] == "free-fall") {
      EXPECT_LT(std::abs(number(row["error"])), 1e-4) << row["integrator"];
    }
  }
  EXPECT_EQ(integrators.size(), 19u);
  for (const auto& [name, keys] : integrators) EXPECT_EQ(keys.size(), softbody::integrators().size()) << name;
  const std::string text = read_file(out / "theory.md");
  for (const char* part : {"nan", "e+0", "100,000 steps at rest"}) EXPECT_EQ(text.find(part), text.npos) << part;
}

TEST(TheoryReport, TakesNoScene) {
  const TemporaryFolder folder;
  const Outcome o = run({"report", "theory", "--scene", "drop", "--out", folder.path() / "out"});
  EXPECT_EQ(o.status, 2);
  EXPECT_NE(o.err.find("leave out --scene"), std::string::npos) << o.err;
}

}  // namespace THIS_FILE
}  // namespace cli::test
