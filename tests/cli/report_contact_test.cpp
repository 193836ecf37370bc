// `report contact`: its files, and its figures on known states.

#include <gtest/gtest.h>

#include "app/report/contact/results.h"
#include "tests/cli/report_rig.h"

namespace cli::test {
namespace THIS_FILE {

const std::string in_space = "gravity = [0, 0, 0]\n[collision]\ntolerance = 0.1\n";

/// Returns the rows of a quick report on one scene without gravity; by "surface", "multi-level-sb",
/// "multi-level-sb-exact".
std::map<std::string, Row> rows_of(const std::string& bodies, std::string* markdown = nullptr) {
  const TemporaryFolder folder;
  const auto scene = folder.write("state.toml", in_space + bodies);
  const auto out = folder.path() / "out";
  const Outcome o = run({"report", "contact", "--quick", "--scene", scene, "--out", out});
  EXPECT_EQ(o.status, 0) << o.err;
  if (markdown) *markdown = read_file(out / "contact.md");
  std::map<std::string, Row> rows;
  for (Row& row : read_csv(out / "contact.csv")) {
    EXPECT_EQ(row["part"], "scene");
    EXPECT_EQ(row["scene"], "state");
    const std::string key = row["method"].empty() ? row["contact_surface"] : row["method"];
    EXPECT_TRUE(rows.emplace(key, std::move(row)).second) << "twice";
  }
  EXPECT_EQ(rows.size(), 3u);
  return rows;
}

/// Returns what such a report measures by surface contact, in at most so many frames.
app::report::ContactTrial surface_trial(const std::string& bodies, int frames) {
  const TemporaryFolder folder;
  softbody::Scene scene = softbody::load_scene(folder.write("state.toml", in_space + bodies));
  return app::report::run_contact_trial(std::move(scene), {.surface = softbody::ContactSurface::surfaces},
                                        {.frames = frames, .stride = 20, .seconds = 1000});
}

TEST(ContactReport, CountsAKnownPenetrationInEveryRow) {
  std::string markdown;
  const auto rows = rows_of("[[body]]\nrelease = 9999\n[[body]]\nposition = [0.8, 3, 0]\nrelease = 9999\n", &markdown);
  for (auto [key, row] : rows) {
    EXPECT_EQ(row["not_run"], "") << key;
    EXPECT_EQ(number(row["radius"]), 0.5);
    EXPECT_EQ(row["bodies"], "2");
    EXPECT_NEAR(number(row["deepest"]), 0.2, 0.02) << key << ": 0.5 m each, 0.8 m apart, held there";
    EXPECT_EQ(row["deepest"], row["end_depth"]);
    EXPECT_GT(number(row["mean_depth"]), 0);
    EXPECT_LT(number(row["mean_depth"]), number(row["deepest"]));
    EXPECT_GT(number(row["penetrations"]), 10 * number(row["looks"]));
    EXPECT_EQ(row["end_overlapping_pairs"], "1");
    EXPECT_EQ(row["passed"], "0");
    EXPECT_EQ(row["jitter"], "0");
    EXPECT_EQ(row["finite"], "1");
    EXPECT_GT(number(row["cpu_ms"]), 0);
    EXPECT_NE(row["failures"].find("R deep at the end"), std::string::npos) << row["failures"];
    EXPECT_EQ(row["failures"].find("awake"), std::string::npos) << "without gravity nothing has to come to rest";
  }
  Row surface = rows.at("surface"), exact = rows.at("multi-level-sb-exact");
  EXPECT_EQ(surface["missed"], "");
  EXPECT_EQ(surface["tolerance"], "");
  EXPECT_EQ(number(exact["tolerance_ratio"]), 1);
  EXPECT_NEAR(number(exact["tolerance"]), 0.1, 1e-6);
  EXPECT_GT(number(exact["missed"]), 0) << "the deepest vertex is 0.2 m from all of the other's";
  EXPECT_LT(number(exact["missed"]), number(exact["penetrations"]));
  EXPECT_NE(markdown.find("| Surface | 1 of 1 |"), std::string::npos) << markdown;
}

TEST(ContactReport, SeesABodyThatFliesThroughAnotherBetweenTwoFrames) {
  const std::string ball = "[[body]]\nmesh = {kind = \"icosphere\", subdivisions = 1}\n";  // of 42 vertices
  const auto rows = rows_of(ball + ball + "position = [0, 9.25, 0.1]\nvelocity = [0, -150, 0]\n");
  for (const char* key : {"multi-level-sb", "multi-level-sb-exact"}) {
    Row row = rows.at(key);
    EXPECT_EQ(row["penetrations"], "0") << "from one side to the other in one frame";
    EXPECT_GT(number(row["passed"]), 42) << "of either body most";
    EXPECT_NE(row["failures"].find("passed"), std::string::npos);
  }
}

TEST(ContactTrial, DoesNotCountABodyThatComesOutOfWhereItStarted) {
  const auto trial = surface_trial("[[body]]\n[[body]]\nposition = [0.8, 3, 0]\n", 600);
  EXPECT_EQ(trial.overlapping_pairs, 0u) << "they came apart";
  EXPECT_GT(trial.crossed_vertices, 0u) << "else this test holds nothing";
  EXPECT_EQ(trial.passed, 0u);
}

/// The ball moves twice its own size in a frame. Straight lines over that lead through the sheet that it carries along.
TEST(ContactTrial, FollowsAFastBodyAlongItsPath) {
  const auto trial = surface_trial(
      "[[body]]\nmesh = {kind = \"grid\", columns = 8, rows = 8, width = 2, depth = 2}\n"
      "[[body]]\nmesh = {kind = \"icosphere\", subdivisions = 1}\n"
      "position = [0.04, 3.8, 0.03]\nvelocity = [0, -100, 0]\n",
      60);
  EXPECT_EQ(trial.not_run, "");
  EXPECT_EQ(trial.passed, 0u);
}

TEST(ContactTrial, GivesNoFiguresOfFramesThatAreCutShort) {
  const std::string ball = "[[body]]\nmesh = {kind = \"icosphere\", subdivisions = 2, radius = 0.02}\n";
  const auto trial = surface_trial(
      ball + "velocity = [1000, 0, 0]\n" + ball + "position = [5, 3, 0]\nvelocity = [-1000, 0, 0]\n", 600);
  EXPECT_NE(trial.not_run.find("more work than there may be"), std::string::npos) << trial.not_run;
}

TEST(ContactTrial, SaysWhatIsWrong) {
  using app::report::ContactTrial;
  const std::vector<std::pair<ContactTrial, Words>> rows{
      {{.radius = 0.5, .solid_depth = 0.0099, .settles = true, .asleep = true, .end_depth = 0.0099}, {}},
      {{.radius = 0.5, .solid_depth = 0.011}, {"0.022 R deep in a solid"}},
      {{.radius = 0.5, .end_depth = 0.011}, {"0.022 R deep at the end"}},
      {{.solid_depth = 1}, {}},  // without a closed body depths have no meaning
      {{.passed = 3, .through_solids = 2, .finite = false}, {"not finite", "through a solid: 2", "passed: 3"}},
      {{.settles = true, .self_intersecting = 1}, {"pierce themselves: 1", "awake"}},
      {{.not_run = "over the budget", .passed = 3}, {"over the budget"}}};
  for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(rows[i].first.failures(), rows[i].second) << "row " << i;
}

TEST(ContactPage, HasAPlotOfASceneAndOfItsImpacts) {
  using namespace app::report;
  ContactResults r;
  r.options.name = "contact";
  r.choices = {{.surface = softbody::ContactSurface::surfaces}, {}};
  ContactCase& scene = r.cases.emplace_back();
  scene.scene.key = "pair";
  for (const ContactChoice& choice : r.choices) scene.trials.push_back({.choice = choice, .radius = 0.5});
  r.cases.push_back(scene);
  r.cases[1].scene.key = "balls";
  r.cases[1].speed = 10;
  const std::string text = contact_page(r).markdown(true);
  for (const char* plot : {"](<contact-time-pair.svg>)", "](<contact-impact-balls.svg>)"})
    EXPECT_NE(text.find(plot), std::string::npos) << plot;
  EXPECT_EQ(text.find("nan"), std::string::npos) << text;
}

TEST(ContactReport, ListsASceneOverBudgetAndDoesNotRunIt) {
  const TemporaryFolder folder;
  const Outcome o = run({"report", "contact", "--quick", "--scene", "drop-3000", "--out", folder.path()});
  EXPECT_EQ(o.status, 0) << o.err;
  for (Row row : read_csv(folder.path() / "contact.csv")) {
    EXPECT_NE(row["not_run"].find("budget"), std::string::npos);
    EXPECT_EQ(row["deepest"], "");
    EXPECT_EQ(row["failures"], "");
  }
  EXPECT_NE(read_file(folder.path() / "contact.md").find("Not run: over the budget"), std::string::npos);
  EXPECT_EQ(file_names(folder.path()), (std::set<std::string>{"contact.csv", "contact.md"})) << "nothing to plot";
}

}  // namespace THIS_FILE
}  // namespace cli::test
