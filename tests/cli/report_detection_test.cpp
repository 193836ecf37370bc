// `report detection`: its files and their contents.

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "collide/methods.h"
#include "tests/cli/detect_rig.h"
#include "tests/cli/report_rig.h"

namespace cli::test {
namespace THIS_FILE {

/// Returns the keys of all methods.
std::set<std::string> all_methods() {
  std::set<std::string> keys;
  for (const collide::Method& method : collide::method_table()) keys.emplace(method.key);
  return keys;
}

/// Checks that the table has every method with all its settings in every state.
void check_table(const std::filesystem::path& report) {
  std::map<std::string, std::set<std::string>> settings;  // by method and frame
  std::set<std::string> frames, methods;
  bool missed = false;  // something, by the literal method
  for (Row row : read_csv(report / "detection.csv")) {
    if (row["part"] != "sweep") continue;
    EXPECT_EQ(row["scene"], "four, 'balls'");
    EXPECT_EQ(row["bodies"], "4");
    EXPECT_EQ(row["vertices"], "648");
    EXPECT_EQ(row["not_run"], "");
    EXPECT_EQ(row["reference"], "brute-force");
    for (const char* column : {"ms_median", "ms_min", "contacts", "true_contacts", "missed", "recall", "precision",
                               "pair_tests", "hashes", "boxes", "memory_bytes", "skipped_far_pairs"})
      EXPECT_GE(number(row[column]), 0) << column;
    EXPECT_LE(number(row["ms_min"]), number(row["ms_median"]));
    EXPECT_GE(number(row["repetitions"]), 1);
    EXPECT_EQ(number(row["contacts"]), number(row["true_contacts"]) - number(row["missed"]));
    EXPECT_EQ(row["precision"], "1");
    const bool literal = row["method"] == "multi-level-sb";
    EXPECT_LE(number(row["recall"]), 1);
    EXPECT_TRUE(literal || (row["recall"] == "1" && row["coverage"] == "exact")) << row["method"];
    EXPECT_TRUE(!literal || number(row["hashes"]) == 8 * number(row["boxes"]));
    EXPECT_TRUE(!literal || row["levels"] != "0" || row["boxes"] == "4");
    EXPECT_TRUE(row["method"] != "brute-force" || row["pair_tests"] == std::to_string(648 * 647 / 2));
    missed |= literal && row["cell"] == "0.25" && row["levels"] == "0" && number(row["recall"]) < 0.9;
    frames.insert(row["frame"]);
    methods.insert(row["method"]);
    EXPECT_TRUE(
        settings[row["method"] + row["frame"]].insert(row["levels"] + "/" + row["buckets"] + "/" + row["cell"]).second)
        << "measured twice";
  }
  EXPECT_TRUE(missed);
  EXPECT_EQ(methods, all_methods());
  EXPECT_EQ(frames.size(), 2u);
  for (const std::string& frame : frames) {
    EXPECT_EQ(settings["brute-force" + frame].size(), 1u);
    EXPECT_EQ(settings["grid-hash" + frame].size(), 4u * 5);
    EXPECT_EQ(settings["multi-level-sb" + frame].size(), 4u * 4 * 5);
  }
}

/// Checks that each study has every method in every state, and that the exact methods find the same contacts.
void check_studies(const std::filesystem::path& report) {
  std::map<std::string, std::map<std::string, std::set<std::string>>> methods, contacts;  // by part and change
  for (Row row : read_csv(report / "detection.csv")) {
    if (row["part"] == "sweep") continue;
    methods[row["part"]][row["change"]].insert(row["method"]);
    if (row["coverage"] == "exact") contacts[row["part"]][row["change"]].insert(row["contacts"]);
  }
  const auto changes = [&](const std::string& part) {
    std::set<std::string> all;
    for (const auto& [change, keys] : methods[part]) {
      all.insert(change);
      EXPECT_EQ(keys, all_methods()) << part << ", " << change;
      EXPECT_EQ(contacts[part][change].size(), 1u) << part << ", " << change;
    }
    return all;
  };
  EXPECT_EQ(changes("growth"), (std::set<std::string>{"3 bodies", "4 bodies"}));
  EXPECT_EQ(changes("density"), (std::set<std::string>{"x 0.7", "x 0.85", "x 1", "x 1.5", "x 3"}));
  EXPECT_EQ(changes("sizes"), (std::set<std::string>{"x 1", "x 2", "x 5", "x 10", "x 20"}));
  EXPECT_EQ(changes("order"), (std::set<std::string>{"as in the scene", "along x", "shuffled"}));
  const auto count = [&](const char* part, const char* change) { return number(*contacts[part][change].begin()); };
  EXPECT_GT(count("density", "x 0.7"), count("density", "x 1"));
  EXPECT_EQ(count("density", "x 3"), 0) << "the bodies are far apart";
  for (const auto& [part, same] : {std::pair("density", "x 1"), {"sizes", "x 1"}, {"order", "along x"}})
    EXPECT_EQ(count(part, same), count("growth", "4 bodies")) << part;
  EXPECT_EQ(count("order", "shuffled"), count("order", "as in the scene"));
}

/// Checks that all methods but brute force have driven the scene, and that those that miss nothing did the same.
void check_misses(const std::filesystem::path& report) {
  std::multiset<std::string> methods;
  std::set<std::string> ends_of_exact;
  for (Row row : read_csv(report / "misses.csv")) {
    EXPECT_EQ(row["scene"], "four, 'balls'");
    EXPECT_GT(number(row["frames"]), 1);
    EXPECT_GT(number(row["ms"]), 0);
    EXPECT_GE(number(row["most inside"]), number(row["inside at the end"]));
    EXPECT_GE(number(row["deepest (m)"]), number(row["depth at the end (m)"]));
    const bool literal = row["driven by"] == "Multi-Level SB";
    const auto method = std::ranges::find(collide::method_table(), row["driven by"], &collide::Method::name);
    ASSERT_NE(method, collide::method_table().end());
    EXPECT_EQ(row["level"].empty(), !method->uses_levels);
    EXPECT_TRUE(!literal || row["cell x"] != "0.15" || number(row["recall"]) < 0.5);
    EXPECT_TRUE(literal || row["recall"] == "1") << row["driven by"];
    if (!literal)
      ends_of_exact.insert(row["frames"] + "/" + row["most inside"] + "/" + row["deepest (m)"] + "/" +
                           row["inside at the end"]);
    methods.insert(row["driven by"]);
  }
  EXPECT_EQ(methods.count("Multi-Level SB"), 5u) << "cell sizes";
  EXPECT_EQ(methods.size(), 5 + collide::method_table().size() - 2);
  EXPECT_EQ(ends_of_exact.size(), 1u);
  const std::string text = read_file(report / "report.md");
  EXPECT_NE(text.find("\n| four, 'balls' | 648 | "), text.npos);
  EXPECT_NE(text.find("](<misses-four, 'balls'.svg>)"), text.npos);
}

/// Checks that the page says how it was made and shows its plots.
void check_page(const std::filesystem::path& report) {
  const std::string text = read_file(report / "report.md");
  EXPECT_NE(text.find("`sbcollide report detection --scene "), std::string::npos);
  EXPECT_NE(text.find("--quick --out DIR`"), std::string::npos);
  for (const char* heading : {"### Growth", "### Density", "### Sizes of the bodies", "### Order of the bodies"})
    EXPECT_NE(text.find(heading), std::string::npos) << heading;
  EXPECT_NE(text.find("1 thread,"), std::string::npos);
  EXPECT_EQ(text.find("nan"), std::string::npos);
  EXPECT_TRUE(std::regex_search(text, std::regex(R"(\n\| Brute force \| \|.*\| \| 2\.00 \|)")))
      << "pair tests are quadratic";
  for (const std::string& name : file_names(report)) {
    EXPECT_GT(std::filesystem::file_size(report / name), 1000u) << name;
    if (name.ends_with(".svg")) {
      EXPECT_NE(text.find("](<" + name + ">)"), std::string::npos) << name;
      EXPECT_TRUE(read_file(report / name).find("</svg>") != std::string::npos) << name;
    }
    if (name.ends_with(".png")) {
      EXPECT_TRUE(read_file(report / name).starts_with("\x89PNG")) << name;
    }
  }
}

/// Four balls fall into each other. The key of their scene has characters that must be quoted.
TEST(DetectionReport, IsWholeIfQuick) {
  const TemporaryFolder folder;
  const auto scene = folder.write("four, 'balls'.toml",
                                  "[collision]\ntolerance = 0.1\n[ground]\n[[body]]\nposition = [0, 0.6, 0]\n"
                                  "lattice = {size = [2, 2, 1], spacing = [1.02, 1.05, 1], jitter = 0.02}\n");
  const auto out = folder.path() / "new" / "report";
  const Outcome o = run({"report", "detection", "--quick", "--scene", scene, "--out", out});
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(printed_files(o, out), file_names(out));
  EXPECT_EQ(errors_of(o), "") << "progress is for terminals";
  check_table(out);
  check_studies(out);
  check_misses(out);
  check_page(out);
}

TEST(DetectionReport, HasThePapersScenesInTable1) {
  const TemporaryFolder folder;
  const Outcome o = run({"report", "detection", "--quick", "--scene", "A", "--threads", "2", "--out", folder.path()});
  EXPECT_EQ(o.status, 0) << o.err;
  const std::string text = read_file(folder.path() / "report.md");
  EXPECT_NE(text.find("| method | A: 3 bodies, 101 buckets |"), std::string::npos);
  EXPECT_NE(text.find(" --threads 2 --out DIR`"), std::string::npos);
  EXPECT_NE(text.find("2 threads,"), std::string::npos);
  EXPECT_EQ(text.find("Growth"), std::string::npos) << "three bodies are too few to grow";
}

/// A sequence of two frames, the first one with fewer contacts, and its rest shape.
class SequenceReport : public testing::Test {
 protected:
  static State stretched(const State& state) {
    State result = state;
    for (Body& body : result.bodies)
      for (auto& vertex : body.vertices) vertex[0] *= 3;
    return result;
  }
  Outcome report(const Words& more) {
    return run(
        with(with({"report", "detection", first, second, "--tolerance", "0.07", "--quick"}, more), {"--out", out}));
  }

  TemporaryFolder folder;
  const State state = random_state(3);
  const std::string out = folder.path() / "out", first = folder.write("far.obj", stretched(state).obj()),
                    second = folder.write("near.obj", state.obj());
};

TEST_F(SequenceReport, MeasuresTheFrameWithTheMostContacts) {
  const Outcome o = report({});
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(printed_files(o, out), file_names(out));
  const std::string contacts = std::to_string(oracle(1, state, {.tolerance = 0.07f}).size());
  std::set<std::string> methods;
  for (Row row : read_csv(std::filesystem::path(out) / "detection.csv")) {
    EXPECT_EQ(row["part"], "sweep");
    EXPECT_EQ(row["frame"], "1");
    EXPECT_EQ(row["bodies"], std::to_string(state.bodies.size()));
    EXPECT_EQ(row["true_contacts"], contacts);
    methods.insert(row["method"]);
  }
  EXPECT_EQ(methods, all_methods());
  const std::string text = read_file(std::filesystem::path(out) / "report.md");
  for (const std::string& part :
       {"`sbcollide report detection " + first + " " + second + " --tolerance 0.07 --quick --out DIR`",
        std::string("recorded sequence of 2"), std::string("far.obj to near.obj")})
    EXPECT_NE(text.find(part), std::string::npos) << part;
  for (const char* part : {"## Table 1", "### Growth"}) EXPECT_EQ(text.find(part), std::string::npos) << part;
}

TEST_F(SequenceReport, TakesBodiesAndRestShapes) {
  const Outcome o = report({"--bodies", "one", "--rest", first});
  EXPECT_EQ(o.status, 0) << o.err;
  const Words options{first, second, "--tolerance", "0.07", "--bodies", "one", "--rest", first};
  const nlohmann::json contacts = detect(options)["frames"][1]["contacts"];
  for (Row row : read_csv(std::filesystem::path(out) / "detection.csv")) {
    EXPECT_EQ(row["bodies"], "1");
    EXPECT_EQ(row["true_contacts"], contacts.dump());
  }
}

TEST(DetectionReport, LeavesOutOnlyThePlotsWithoutGnuplot) {
  const TemporaryFolder folder;
  const auto two = folder.write("two.obj", "v 0 0 0\no b\nv 0 .01 0\n"), out = folder.path() / "out";
  const Outcome o = run({"report", "detection", two, "--tolerance", "0.1", "--quick", "--out", out}, "/",
                        {"PATH=" + folder.path().string()});
  EXPECT_EQ(o.status, 0);
  const std::string errors = errors_of(o);
  EXPECT_NE(errors.find("gnuplot-nox"), std::string::npos) << errors;
  EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 1);
  EXPECT_EQ(printed_files(o, out), file_names(out));
  EXPECT_EQ(file_names(out), (std::set<std::string>{"detection.csv", "report.md"}));
  EXPECT_EQ(read_file(out / "report.md").find("!["), std::string::npos) << "no links to what is not there";
}

TEST(Report, RefusesBadInputInOneLineAndWritesNothing) {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("mesh.obj", random_state(3).obj()),
                    lone = folder.write("lone.obj", "v 0 0 0\n"), out = folder.path() / "out",
                    nobody = folder.write("nobody.toml", "[dropper]\n"),
                    empty = folder.write("empty.toml", "name = \"nothing\"\n");
  const Words to_out{"--quick", "--out", out}, sequence{"detection", mesh, "--tolerance"};
  const auto before = file_names(folder.path());
  std::vector<std::pair<Words, Words>> rows{
      {{"detection", "--quick"}, {"--out"}},
      {to_out, {"say which one", "stability"}},
      {with(to_out, {"friction"}), {"friction", "use one of: detection"}},
      {with(to_out, {"detection", "--scene", "E"}), {"E", "drop-3000"}},
      {with(to_out, {"detection", "--threads", "0"}), {"--threads"}},
      {with(to_out, {"detection", mesh}), {"--tolerance", "missing"}},
      {with(to_out, with(sequence, {"-1"})), {"--tolerance -1"}},
      {with(to_out, with(sequence, {""})), {"--tolerance"}},
      {with(to_out, with(sequence, {"1", "--scene", "A"})), {"--scene A", "without files"}},
      {with(to_out, with(sequence, {"1", "--bodies", "two"})), {"--bodies two"}},
      {with(to_out, with(sequence, {"1", lone})), {lone, "number of bodies"}},
      {with(to_out, {"detection", folder.path() / "none.ply", "--tolerance", "1"}), {"none.ply", "cannot be read"}},
      {with(to_out, {"contact", mesh, "--tolerance", "1"}), {"report contact", "only report detection takes files"}},
      {with(to_out, {"detection", "--tolerance", "1"}), {"--tolerance", "goes with files"}},
      {with(to_out, {"detection", "--rest", mesh}), {"--rest", "goes with files"}},
      {with(to_out, {"solver", "--bodies", "one"}), {"--bodies", "goes with files"}}};
  for (const char* report : {"solver", "stability"}) {
    rows.push_back({with(to_out, {report, "--scene", empty}), {"no body"}});
    rows.push_back({with(to_out, {report, "--scene", "nowhere"}), {"nowhere"}});
  }
  for (const char* appear : {"appear = 5\n", "appear = 500\n", "\n[[body]]\nposition = [3, 3, 0]\nappear = 5\n"}) {
    const TemporaryFolder scenes;
    const std::string late = scenes.write("late.toml", std::string("[[body]]\n") + appear);
    expect_refused(with({"report", "solver", "--scene", late}, to_out), {"join after the start"});
  }
  for (const auto& [arguments, says] : rows) expect_refused(with({"report"}, arguments), says);
  EXPECT_EQ(file_names(folder.path()), before) << "not even the folder";
  expect_refused(with({"report", "detection", "--scene", nobody}, to_out), {"nobody", "no body"});
  EXPECT_EQ(file_names(out), std::set<std::string>{}) << "known only after a simulation";
}

}  // namespace THIS_FILE
}  // namespace cli::test
