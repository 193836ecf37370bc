// `report stability`: its files, and cells that are known.

#include <gtest/gtest.h>

#include "softbody/integrate/integrators.h"
#include "tests/cli/report_rig.h"

namespace cli::test {
namespace THIS_FILE {

const std::vector<std::string> dts{"0.0333333333", "0.0166666667", "0.00416666667"};

/// Returns the cells by "case integrator dt stiffness".
std::map<std::string, Row> cells_of(const std::filesystem::path& csv) {
  std::map<std::string, Row> cells;
  for (Row& row : read_csv(csv)) {
    if (row["part"] != "cell") continue;
    const std::string key = row["case"] + " " + row["integrator"] + " " + row["dt"] + " " + row["stiffness"];
    EXPECT_TRUE(cells.emplace(key, std::move(row)).second) << key << " twice";
  }
  return cells;
}

TEST(StabilityReport, HasEveryCellAndTheStableStepsIfQuick) {
  const TemporaryFolder folder;
  const auto out = folder.path() / "out";
  const Outcome o = run({"report", "stability", "--quick", "--out", out});
  ASSERT_EQ(o.status, 0) << o.err;
  auto cells = cells_of(out / "stability.csv");
  for (const char* key : {"rest", "flattened", "impact-100"})
    for (const softbody::Integrator& i : softbody::integrators())
      for (const std::string& dt : dts)
        for (const char* k : {"10", "10000", "100000000"}) {
          std::string cell(key);
          cell.append(" ").append(i.key).append(" ").append(dt).append(" ").append(k);
          ASSERT_TRUE(cells.contains(cell)) << cell;
          Row& row = cells[cell];
          EXPECT_EQ(row["passes"] == "1", row["failures"].empty()) << cell;
        }
  EXPECT_EQ(cells["rest velocity-verlet 0.00416666667 10"]["passes"], "1");
  Row lost = cells["flattened explicit-euler 0.0333333333 100000000"];
  EXPECT_EQ(lost["passes"], "0");
  EXPECT_GT(number(lost["blew_up"]), 0);
  EXPECT_LT(number(lost["blew_up"]), 1) << "it is not run to the end";
  EXPECT_NE(cells["flattened rk4 0.0333333333 10"]["not_judged"], "") << "so soft a ball swings for minutes";
  EXPECT_EQ(cells["flattened rk4 0.0333333333 10000"]["not_judged"], "");

  std::map<std::string, double> steps;
  for (Row row : read_csv(out / "stability.csv")) {
    if (row["part"] != "step") continue;
    const double found = number(row["stable_step"]);
    EXPECT_TRUE(!steps.contains(row["integrator"]) || found <= steps[row["integrator"]]) << "stiffer: shorter";
    steps[row["integrator"]] = found;
    if (row["integrator"] != "velocity-verlet" && row["integrator"] != "rk4") continue;
    EXPECT_GT(found, number(row["predicted_step"])) << "what solvers trust holds";
    EXPECT_LT(found, 4 * number(row["predicted_step"])) << "and is no fantasy";
  }
  EXPECT_EQ(steps.size(), softbody::integrators().size());
  const std::string text = read_file(out / "stability.md");
  for (const softbody::Integrator& i : softbody::integrators())
    EXPECT_NE(text.find("| " + std::string(i.name) + " |"), std::string::npos);
  EXPECT_EQ(text.find("nan"), std::string::npos);
}

TEST(StabilityReport, TakesASceneAndScalesItsStiffness) {
  const TemporaryFolder folder;
  const auto scene = folder.write(
      "drop.toml",
      "[[material]]\nname = \"m\"\nstructural = {stiffness = 100, damping_ratio = 0.1}\n[ground]\n"
      "[[body]]\nmesh = {kind = \"icosphere\", subdivisions = 1, radius = 0.3}\nposition = [0, 0.31, 0]\n");
  const auto out = folder.path() / "out";
  const Outcome o = run({"report", "stability", "--quick", "--threads", "1", "--scene", scene, "--out", out});
  ASSERT_EQ(o.status, 0) << o.err;
  auto cells = cells_of(out / "stability.csv");
  EXPECT_EQ(cells.size(), 3 * dts.size() * softbody::integrators().size()) << "three factors";
  EXPECT_EQ(cells["drop semi-implicit-euler 0.00416666667 1"]["failures"], "");
  EXPECT_EQ(cells["drop semi-implicit-euler 0.0333333333 1000"]["passes"], "0");
  EXPECT_NE(cells["drop rk4 0.0333333333 1"]["not_judged"].find("does not model"), std::string::npos);
  EXPECT_EQ(file_names(out), (std::set<std::string>{"stability.csv", "stability.md"})) << "no map of another scene";
}

}  // namespace THIS_FILE
}  // namespace cli::test
