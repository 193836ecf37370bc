// `report detection`: its files and their contents.

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>

#include "tests/cli/detect_rig.h"
#include "tests/cli/report_rig.h"

namespace cli::test {
namespace THIS_FILE {

/// Returns a scene of four balls that fall into each other. Its key has characters that must be quoted.
const std::filesystem::path& balls() {
  static const TemporaryFolder folder;
  static const auto file = folder.write("four, 'balls'.toml", R"(
[collision]
tolerance = 0.1
[ground]
[[body]]
position = [0, 0.6, 0]
lattice = {size = [2, 2, 1], spacing = [1.02, 1.05, 1], jitter = 0.02}
)");
  return file;
}

/// Returns the folder of a quick report on them, which is made once.
const std::filesystem::path& quick_report() {
  static const TemporaryFolder folder;
  static const auto out = folder.path() / "new" / "report";
  static const Outcome o = run({"report", "detection", "--quick", "--scene", balls(), "--out", out});
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(printed_files(o, out), file_names(out));
  EXPECT_EQ(errors_of(o), "") << "progress is for terminals";
  return out;
}

std::vector<Row> sweep_rows() {
  std::vector<Row> rows;
  for (Row& row : read_csv(quick_report() / "detection.csv")) {
    if (row["part"] == "sweep") rows.push_back(std::move(row));
  }
  return rows;
}

std::string methods_table() { return run({"list", "methods"}).out; }

TEST(DetectionReport, HasEveryMethodWithAllItsSettingsInEveryState) {
  std::map<std::string, std::set<std::string>> settings;  // by method and frame
  std::set<std::string> frames, methods;
  const auto rows = sweep_rows();
  for (Row row : rows) {
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
    frames.insert(row["frame"]);
    methods.insert(row["method"]);
    EXPECT_NE(methods_table().find(row["method"] + "\t"), std::string::npos);
    EXPECT_TRUE(
        settings[row["method"] + row["frame"]].insert(row["levels"] + "/" + row["buckets"] + "/" + row["cell"]).second)
        << "measured twice";
  }
  const std::string table = methods_table();
  EXPECT_EQ(methods.size(), static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n')));
  EXPECT_EQ(frames.size(), 2u);
  for (const std::string& frame : frames) {
    EXPECT_EQ(settings["brute-force" + frame].size(), 1u);
    EXPECT_EQ(settings["grid-hash" + frame].size(), 4u * 5);
    EXPECT_EQ(settings["multi-level-sb" + frame].size(), 4u * 4 * 5);
  }
}

TEST(DetectionReport, ShowsThatOnlyTheLiteralMethodMissesContacts) {
  bool missed = false;
  for (Row row : sweep_rows()) {
    EXPECT_EQ(row["precision"], "1");
    if (row["method"] != "multi-level-sb") {
      EXPECT_EQ(row["recall"], "1") << row["method"];
      EXPECT_EQ(row["coverage"], "exact");
    } else {
      EXPECT_LE(number(row["recall"]), 1);
      missed |= row["cell"] == "0.25" && row["levels"] == "0" && number(row["recall"]) < 0.9;
    }
  }
  EXPECT_TRUE(missed);
}

TEST(DetectionReport, HasTheCountsOfTheMethods) {
  for (Row row : sweep_rows()) {
    if (row["method"] == "multi-level-sb") {
      EXPECT_EQ(number(row["hashes"]), 8 * number(row["boxes"]));
    }
    if (row["method"] == "multi-level-sb" && row["levels"] == "0") {
      EXPECT_EQ(row["boxes"], "4");
    }
    if (row["method"] == "brute-force") {
      EXPECT_EQ(row["pair_tests"], std::to_string(648 * 647 / 2));
    }
  }
}

TEST(DetectionReport, MeasuresGrowthOnMoreAndMoreBodies) {
  std::set<std::string> bodies;
  for (Row row : read_csv(quick_report() / "detection.csv")) {
    if (row["part"] == "growth") bodies.insert(row["bodies"]);
  }
  EXPECT_EQ(bodies, (std::set<std::string>{"3", "4"}));
}

TEST(DetectionReport, SaysHowItWasMadeAndShowsItsPlots) {
  const std::string text = read_file(quick_report() / "report.md");
  EXPECT_NE(text.find("`sbcollide report detection --scene "), std::string::npos);
  EXPECT_NE(text.find("--quick --out DIR`"), std::string::npos);
  EXPECT_NE(text.find("1 thread,"), std::string::npos);
  EXPECT_EQ(text.find("nan"), std::string::npos);
  for (const std::string& name : file_names(quick_report())) {
    EXPECT_GT(std::filesystem::file_size(quick_report() / name), 1000u) << name;
    if (name.ends_with(".svg")) {
      EXPECT_NE(text.find("](<" + name + ">)"), std::string::npos) << name;
      EXPECT_TRUE(read_file(quick_report() / name).find("</svg>") != std::string::npos) << name;
    }
    if (name.ends_with(".png")) {
      EXPECT_TRUE(read_file(quick_report() / name).starts_with("\x89PNG")) << name;
    }
  }
}

TEST(DetectionReport, HasThePapersScenesInTable1) {
  const TemporaryFolder folder;
  const Outcome o = run({"report", "detection", "--quick", "--scene", "A", "--threads", "2", "--out", folder.path()});
  EXPECT_EQ(o.status, 0) << o.err;
  const std::string text = read_file(folder.path() / "report.md");
  EXPECT_NE(text.find("| method | A: 3 bodies, 101 buckets |"), std::string::npos);
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
  Outcome report(std::vector<std::string> more) {
    more.insert(more.begin(), {"report", "detection", first, second});
    more.insert(more.end(), {"--out", out});
    return run(more);
  }

  TemporaryFolder folder;
  const State state = random_state(3);
  const std::string out = folder.path() / "out", first = folder.write("far.obj", stretched(state).obj()),
                    second = folder.write("near.obj", state.obj());
};

TEST_F(SequenceReport, MeasuresTheFrameWithTheMostContacts) {
  const Outcome o = report({"--tolerance", "0.07", "--quick"});
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
  const std::string table = methods_table();
  EXPECT_EQ(methods.size(), static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n')));
  const std::string text = read_file(std::filesystem::path(out) / "report.md");
  EXPECT_NE(text.find("`sbcollide report detection " + first + " " + second + " --tolerance 0.07 --quick --out DIR`"),
            std::string::npos);
  EXPECT_NE(text.find("recorded sequence of 2"), std::string::npos);
  EXPECT_NE(text.find("far.obj to near.obj"), std::string::npos);
  EXPECT_EQ(text.find("## Table 1"), std::string::npos);
  EXPECT_EQ(text.find("### Growth"), std::string::npos);
}

TEST_F(SequenceReport, TakesBodiesAndRestShapes) {
  const Outcome o = report({"--tolerance", "0.07", "--quick", "--bodies", "one", "--rest", first});
  EXPECT_EQ(o.status, 0) << o.err;
  State one{{{}}};
  State rest = one;
  for (const auto& [from, to] : {std::pair(state, &one), std::pair(stretched(state), &rest)}) {
    for (const Body& body : from.bodies) {
      const unsigned base = static_cast<unsigned>(to->bodies[0].vertices.size());
      to->bodies[0].vertices.insert(to->bodies[0].vertices.end(), body.vertices.begin(), body.vertices.end());
      for (std::vector<unsigned> face : body.faces) {
        for (unsigned& corner : face) corner += base;
        to->bodies[0].faces.push_back(face);
      }
    }
  }
  const std::string contacts = std::to_string(oracle(1, one, {.tolerance = 0.07f, .rest = &rest}).size());
  for (Row row : read_csv(std::filesystem::path(out) / "detection.csv")) {
    EXPECT_EQ(row["bodies"], "1");
    EXPECT_EQ(row["true_contacts"], contacts);
  }
}

TEST_F(SequenceReport, RefusesBadInputInOneLineAndWritesNothing) {
  const auto refuse = [&](std::vector<std::string> arguments, const std::vector<std::string>& words) {
    arguments.insert(arguments.begin(), "report");
    arguments.insert(arguments.end(), {"--out", out, "--quick"});
    expect_refused(arguments, words);
    EXPECT_FALSE(std::filesystem::exists(out));
  };
  const std::string lone = folder.write("lone.obj", "v 0 0 0\n");
  refuse({"detection", first}, {"--tolerance", "missing"});
  refuse({"detection", first, "--tolerance", "-1"}, {"--tolerance -1"});
  refuse({"detection", first, "--tolerance", ""}, {"--tolerance"});
  refuse({"detection", first, "--tolerance", "1", "--scene", "A"}, {"--scene A", "without files"});
  refuse({"detection", first, "--tolerance", "1", "--bodies", "two"}, {"--bodies two"});
  refuse({"detection", first, lone, "--tolerance", "1"}, {lone, "number of bodies"});
  refuse({"detection", folder.path() / "none.ply", "--tolerance", "1"}, {"none.ply", "cannot be read"});
  refuse({"contact", first, "--tolerance", "1"}, {"report contact", "only report detection takes files"});
  refuse({"detection", "--tolerance", "1"}, {"--tolerance", "goes with files"});
  refuse({"detection", "--rest", first}, {"--rest", "goes with files"});
  refuse({"solver", "--bodies", "one"}, {"--bodies", "goes with files"});
}

TEST(DetectionReport, LeavesOutOnlyThePlotsWithoutGnuplot) {
  const TemporaryFolder folder;
  const std::string path = getenv("PATH");
  setenv("PATH", folder.path().c_str(), 1);
  const Outcome o = run({"report", "detection", "--quick", "--scene", balls(), "--out", folder.path()});
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(o.status, 0);
  const std::string errors = errors_of(o);
  EXPECT_NE(errors.find("gnuplot-nox"), std::string::npos) << errors;
  EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 1);
  EXPECT_EQ(printed_files(o, folder.path()), file_names(folder.path()));
  EXPECT_EQ(file_names(folder.path()), (std::set<std::string>{"detection.csv", "report.md"}));
  EXPECT_EQ(read_file(folder.path() / "report.md").find("!["), std::string::npos) << "no links to what is not there";
}

TEST(DetectionReport, RefusesBadInputInOneLineAndWritesNothing) {
  const TemporaryFolder folder;
  const auto file = folder.write("file", "not a folder");
  const auto nobody = folder.write("nobody.toml", "[dropper]\n");
  const auto refused = [](std::vector<std::string> arguments, const std::vector<std::string>& says) {
    arguments.insert(arguments.begin(), "report");
    const Outcome o = run(arguments);
    EXPECT_EQ(o.status, 2);
    EXPECT_EQ(o.out, "");
    EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << o.err;
    for (const std::string& words : says) EXPECT_NE(o.err.find(words), std::string::npos) << words << " in: " << o.err;
  };
  const std::string out = folder.path() / "out";
  refused({"detection", "--quick"}, {"--out"});
  refused({"--out", out}, {"say which one", "stability"});
  refused({"friction", "--out", out}, {"friction", "use one of: detection"});
  refused({"detection", "--scene", "E", "--out", out}, {"E", "drop-3000"});
  refused({"detection", "--threads", "0", "--out", out}, {"--threads"});
  refused({"detection", "--quick", "--out", file}, {"--out", file.string()});
  refused({"detection", "--quick", "--out", file / "below"}, {"--out", file.string()});
  EXPECT_EQ(read_file(file), "not a folder");
  EXPECT_FALSE(std::filesystem::exists(out)) << "not even the folder";
  refused({"detection", "--scene", nobody, "--quick", "--out", out}, {"nobody", "no body"});
  EXPECT_EQ(file_names(out), std::set<std::string>{}) << "known only after a simulation";
}

}  // namespace THIS_FILE
}  // namespace cli::test
