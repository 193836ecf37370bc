// `report solver`: its files, and figures that are known beforehand.

#include <gtest/gtest.h>

#include "app/report/solver/results.h"
#include "tests/cli/report_rig.h"

namespace cli::test {
namespace THIS_FILE {

/// Returns the rows of each integrator, in order.
std::map<std::string, std::vector<Row>> curves_of(const std::filesystem::path& csv) {
  std::map<std::string, std::vector<Row>> curves;
  for (Row& row : read_csv(csv)) curves[row["integrator"]].push_back(row);
  return curves;
}

/// Returns the text of a scene in which a small ball falls freely. `more`: of its material.
std::string falling_ball(const std::string& more = "") {
  return "[collision]\nself_collision = false\n[[material]]\nname = \"ball\"\nstructural = {stiffness = 100, "
         "damping_ratio = 0.05}\nbend = {stiffness = 25, damping_ratio = 0.05}\nrolling_resistance = 0\n" +
         more + "[[body]]\nmesh = {kind = \"icosphere\", subdivisions = 1, radius = 0.3}\nposition = [0, 50, 0]\n";
}

TEST(SolverReport, HasEveryIntegratorAndItsFigures) {
  const TemporaryFolder folder;
  const auto scene = folder.write("ball.toml", falling_ball()), out = folder.path() / "out";
  const Outcome o = run({"report", "solver", "--quick", "--scene", scene, "--out", out});
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(printed_files(o, out), file_names(out));
  auto curves = curves_of(out / "solver.csv");
  EXPECT_EQ(curves.size(), softbody::integrators().size());
  bool cut_short = false;  // a curve, by the time that its runs took
  for (const softbody::Integrator& i : softbody::integrators()) {
    const auto curve = curves.find(std::string(i.key));
    ASSERT_NE(curve, curves.end()) << i.key;
    Row first = curve->second.front(), last = curve->second.back();
    constexpr double known = 2e-5;  // R, to which the reference is: there a curve ends
    // How many runs come before that is up to the machine: with the thread sanitizer two of XPBD.
    if (!i.automatic && number(last["error"]) > known) cut_short = true;
    if (!i.automatic) {
      EXPECT_EQ(first["substeps"], "1");
      EXPECT_NEAR(number(first["steps_per_second"]), 60 * i.substeps_per_step, 1e-6);
    }
    EXPECT_EQ(last["blew_up"], "0") << i.key;
    EXPECT_LT(number(last["error"]), i.automatic ? 5e-2 : 1e-2) << i.key << ", which may stay with the bound's steps";
    EXPECT_GT(number(last["cpu_ms_alone"]), 0);
    EXPECT_EQ(last["linear_error"], "") << "it falls";
    EXPECT_EQ(last["own_error"] == "", std::ranges::count(app::report::own_step_integrators, i.key) == 0);
    EXPECT_EQ(last["promise_kept"], "1");
    EXPECT_GT(number(last["substeps_taken"]), 0);
    if (!i.automatic) {
      EXPECT_EQ(number(last["substeps_taken"]), number(last["substeps"]) * i.substeps_per_step);
    }
    curve->second.pop_back();
    for (Row& before : curve->second)
      EXPECT_TRUE(before["blew_up"] == "1" || number(before["error"]) > known) << i.key << ": nothing more is learnt";
    EXPECT_LT(number(last["volume_error"]), 1e-2);
    EXPECT_EQ(last["reference_converged"], "1");
    EXPECT_LT(number(last["reference_change"]), 1e-4);
    EXPECT_GT(number(last["perturbation_growth"]), 0);
  }
  const std::string text = read_file(out / "solver.md");
  EXPECT_NE(text.find("RK4 in double"), std::string::npos);
  EXPECT_EQ(text.find("nan"), std::string::npos);
  EXPECT_NE(text.find(cut_short ? "since runs took longer than" : "All curves end"), std::string::npos);
}

TEST(SolverCase, IsComparedWithTheWorldWhereTheReferenceDoesNotModelTheScene) {
  const TemporaryFolder folder;
  const auto file = folder.write("ball.toml", falling_ball("internal_damping = 5\n"));
  const auto c =
      app::report::begin_case({.key = "ball", .name = "ball", .scene = softbody::load_scene(file)}, 2e-5, 8'000);
  EXPECT_EQ(c.reference.what, "the world's rk4 in floats");
  EXPECT_LT(c.own("auto").error, 5e-2);
}

TEST(MeasureStiffness, FindsThatAMaterialSagsAndSwingsAlikeInFinerMeshes) {
  const auto bodies = app::report::measure_stiffness(true);
  ASSERT_EQ(bodies.size(), 6u);
  for (std::size_t i = 0; i < bodies.size(); i += 2) {
    const auto &coarse = bodies[i], &fine = bodies[i + 1];
    EXPECT_EQ(fine.body, coarse.body);
    EXPECT_GT(fine.particles, 3 * coarse.particles);
    EXPECT_GT(coarse.sag, 0.05) << coarse.body << ": it is soft";
    EXPECT_NEAR(fine.sag, coarse.sag, 0.1 * coarse.sag) << coarse.body;
    EXPECT_NEAR(fine.period, coarse.period, 0.1 * coarse.period) << coarse.body;
  }
}

/// The reference is coarser than the report's, but for the errors at hand fine enough.
TEST(SolverScenes, AutoKeepsItsPromise) {
  constexpr double bound = 1e-3;           // R, a tenth of what is promised
  constexpr std::uint64_t steps = 60'000;  // of the reference, at most
  for (const app::report::SolverScene& scene : app::report::solver_scenes()) {
    if (scene.at_rest) continue;  // balls as stiff that fly show more
    const app::report::SolverCase c = begin_case(scene, bound, steps);
    EXPECT_TRUE(c.reference.converged) << scene.key;
    EXPECT_TRUE(c.keeps_promise()) << scene.key << ": " << c.own("auto").error << " R of " << c.allowed() << " R";
  }
}

}  // namespace THIS_FILE
}  // namespace cli::test
