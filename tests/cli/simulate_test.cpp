// The JSON document of `simulate`, and the effect of the options.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <regex>
#include <set>
#include <sstream>
#include <thread>

#include "tests/cli/process.h"

namespace cli::test {
namespace THIS_FILE {

using nlohmann::json;

std::set<std::string> keys(const json& object) {
  std::set<std::string> names;
  for (const auto& [key, value] : object.items()) names.insert(key);
  return names;
}

using Keys = std::set<std::string>;

/// A ball with gas, close above the ground, so that something happens within a few frames.
constexpr const char* small_scene = R"(
[collision]
tolerance = 0.1
[ground]
[[material]]
gas_pressure = 113000
ambient_pressure = 101325
[[body]]
position = [0, 0.55, 0]
[[body]]
position = [0.1, 1.7, 0]
)";

TEST(Simulate, PrintsOneDocumentOfTheContractsForm) {
  const json d = simulate({"--scene", "drop", "--frames", "5"});
  EXPECT_EQ(keys(d), (Keys{"scene", "method", "integrator", "plan", "warnings", "frames", "state_hash"}));
  EXPECT_EQ(d["scene"], "drop");
  EXPECT_EQ(d["method"], "multi-level-sb-exact");
  EXPECT_EQ(d["integrator"]["key"], "auto");
  EXPECT_TRUE(std::regex_match(d["state_hash"].get<std::string>(), std::regex("[0-9a-f]{16}")));
  ASSERT_EQ(d["frames"].size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    const json& f = d["frames"][i];
    EXPECT_EQ(keys(f), (Keys{"frame", "time", "ms", "contacts", "energy", "energies", "volume_ratio",
                             "deepest_penetration", "max_speed", "finite"}));
    EXPECT_EQ(f["frame"], i + 1) << "frame n is the state after n steps";
    EXPECT_EQ(keys(f["ms"]), (Keys{"detect", "solve", "total"}));
    EXPECT_EQ(keys(f["contacts"]), (Keys{"bodies", "self", "solid"}));
    EXPECT_EQ(keys(f["energies"]), (Keys{"kinetic", "elastic", "gas", "gravity"}));
    EXPECT_EQ(keys(f["volume_ratio"]), (Keys{"min", "max"}));
    for (const char* key : {"detect", "solve", "total"}) EXPECT_TRUE(f["ms"][key].is_number()) << key;
    for (const char* key : {"bodies", "self", "solid"}) EXPECT_TRUE(f["contacts"][key].is_number_unsigned()) << key;
    for (const char* key : {"energy", "deepest_penetration", "max_speed"}) EXPECT_TRUE(f[key].is_number()) << key;
    EXPECT_GE(f["deepest_penetration"], 0.0);
    EXPECT_EQ(f["finite"], true);
    EXPECT_NEAR(f["volume_ratio"]["min"], 1, 1e-3);
  }
}

TEST(Simulate, ReadsLeadingZerosAsDecimal) {
  EXPECT_EQ(simulate({"--scene", "drop", "--frames", "010"})["frames"].size(), 10u);
}

TEST(Simulate, NamesEachStageOnceAndWhyOthersAreLeftOut) {
  const TemporaryFolder folder;
  const auto scene = folder.write("small.toml", small_scene);
  const json d = simulate({"--scene", scene, "--frames", "1"});
  EXPECT_EQ(d["scene"], "small");
  const json& plan = d["plan"];
  EXPECT_EQ(keys(plan), (Keys{"stages", "shapes", "left_out"}));
  Keys all;
  for (const json& s : plan["stages"]) EXPECT_TRUE(all.insert(s).second);
  for (const json& l : plan["left_out"]) {
    EXPECT_EQ(keys(l), (Keys{"stage", "why"}));
    EXPECT_TRUE(all.insert(l["stage"]).second);
    EXPECT_FALSE(l["why"].get<std::string>().empty());
  }
  EXPECT_EQ(
      all, (Keys{"arrive", "contact-response", "surface-contact", "structural-springs", "bend-springs", "shear-springs",
                 "gas-pressure", "shape-matching", "grab", "gravity", "integrate", "restitution", "solids",
                 "solid-features", "internal-damping", "rebound-damping", "rolling-resistance", "detect", "sleep"}));
  const auto runs = [&](const char* stage) {
    return std::find(plan["stages"].begin(), plan["stages"].end(), stage) != plan["stages"].end();
  };
  EXPECT_TRUE(runs("solids") && runs("gas-pressure") && runs("detect"));
  EXPECT_EQ(plan["shapes"], json::array({"ground"}));
  EXPECT_FALSE(runs("arrive") || runs("shear-springs"));
}

TEST(Simulate, PrintsFiguresThatAgreeWithPhysics) {
  const TemporaryFolder folder;
  const auto scene = folder.write("fall.toml",
                                  "[collision]\nself_collision = false\n[[material]]\nmass = 2\n[[body]]\n"
                                  "position = [0, 50, 0]\nvelocity = [3, 0, 0]\n[ground]\n");
  const json d = simulate({"--scene", scene, "--frames", "60"});
  const json& last = d["frames"][59];
  EXPECT_NEAR(last["max_speed"], std::hypot(3, 9.81), 1e-3) << "after a second";
  EXPECT_NEAR(last["energy"], 2 * 9.81 * 50 + 0.5 * 2 * 9, 10) << "joules: potential and kinetic";
  EXPECT_EQ(last["contacts"], json({{"bodies", 0}, {"self", 0}, {"solid", 0}}));
  EXPECT_EQ(last["deepest_penetration"], 0.0);
}

TEST(Simulate, PrintsEnergiesWhoseSumIsTheEnergy) {
  const TemporaryFolder folder;
  const auto scene = folder.write("small.toml", small_scene);
  for (const json& frame : simulate({"--scene", scene, "--frames", "20"})["frames"]) {
    const json& e = frame["energies"];
    const double energy = frame["energy"];
    EXPECT_NEAR(double(e["kinetic"]) + double(e["elastic"]) + double(e["gas"]) + double(e["gravity"]), energy,
                1e-9 * std::abs(energy));
    EXPECT_GT(e["kinetic"], 0.0);
    EXPECT_GT(e["elastic"], 0.0) << "the gas stretches the springs from the start";
  }
}

/// Returns the lines of standard output, each an object.
std::vector<json> parse_lines(const std::string& text) {
  std::vector<json> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(json::parse(line, nullptr, false));
  return lines;
}

TEST(SimulateJsonLines, HaveTheFramesAndThenTheRestOfTheDocument) {
  const TemporaryFolder folder;
  const auto scene = folder.write("small.toml", small_scene);
  const std::vector<std::string> arguments{"--scene", scene, "--frames", "15", "--oracle"};
  json document = simulate(arguments);
  std::vector<std::string> line_arguments{"simulate", "--json-lines"};
  line_arguments.insert(line_arguments.end(), arguments.begin(), arguments.end());
  const Outcome o = run(line_arguments);
  EXPECT_EQ(o.status, 0);
  EXPECT_EQ(o.err, "");
  std::vector<json> lines = parse_lines(o.out);
  ASSERT_EQ(lines.size(), 16u);
  const auto without_times = [](json& frame) {
    EXPECT_EQ(frame.erase("ms"), 1u);
    return frame;
  };
  for (std::size_t i = 0; i < 15; ++i) EXPECT_EQ(without_times(lines[i]), without_times(document["frames"][i]));
  document.erase("frames");
  EXPECT_EQ(lines.back(), document);
}

TEST(SimulateJsonLines, ArriveFrameByFrame) {
  const TemporaryFolder folder;
  const auto lines = folder.path() / "lines";
  const std::vector<std::string> arguments{"simulate", "--scene", "drop", "--frames", "10000000", "--json-lines"};
  Process process(arguments, "/", {}, lines);
  const auto arrived = [&] {
    const std::string text = read_file(lines);
    return std::count(text.begin(), text.end(), '\n');
  };
  while (process.running() && arrived() < 3) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  process.send(SIGTERM);
  const Outcome o = process.wait();
  EXPECT_EQ(o.signal, SIGTERM) << o.err;
  const std::vector<json> parsed = parse_lines(o.out);
  ASSERT_GE(parsed.size(), 3u);
  EXPECT_EQ(parsed[2]["frame"], 3);
  EXPECT_TRUE(o.out.ends_with('\n')) << "whole lines";
}

TEST(SimulateJsonLines, EndTheRunWhenStandardOutputIsFull) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no full device";
  for (const char* frames : {"2", "10000000"}) {
    Process process({"simulate", "--scene", "drop", "--frames", frames, "--json-lines"}, "/", {}, "/dev/full");
    const Outcome o = process.wait();
    EXPECT_EQ(o.status, 2);
    EXPECT_EQ(o.err, "sbcollide: standard output cannot be written to; is the disk full, or did its reader end?\n");
  }
}

TEST(SimulateJsonLines, EndTheRunWhenTheReaderEnds) {
  const TemporaryFolder folder;
  const std::string pipe = folder.path() / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  ASSERT_GE(reader, 0);
  Process process({"simulate", "--scene", "drop", "--frames", "10000000", "--json-lines"}, "/", {}, pipe);
  pollfd arrival{.fd = reader, .events = POLLIN, .revents = 0};
  EXPECT_EQ(poll(&arrival, 1, 60'000), 1) << "nothing was printed";
  close(reader);
  const Outcome o = process.wait();
  EXPECT_EQ(o.status, 2) << "signal " << o.signal;
  EXPECT_NE(o.err.find("did its reader end?"), std::string::npos) << o.err;
}

TEST(Simulate, PrintsNoVolumeRatioOfOpenMeshes) {
  const TemporaryFolder folder;
  const auto scene = folder.write("sheet.toml", "[[body]]\nmesh = {kind = \"grid\", columns = 3, rows = 3}\n");
  const json ratio = simulate({"--scene", scene, "--frames", "1"})["frames"][0]["volume_ratio"];
  EXPECT_TRUE(ratio["min"].is_null() && ratio["max"].is_null());
  const std::string table = run({"simulate", "--scene", scene, "--frames", "1"}).out;
  EXPECT_TRUE(std::regex_search(table, std::regex("\n +1 .* - +- .*\n"))) << table;
}

TEST(Simulate, PrintsTheSameStateHashForAllThreadsAndExactMethods) {
  const auto hash = [](std::vector<std::string> more) {
    more.insert(more.end(), {"--scene", "drop", "--frames", "260"});
    return simulate(more)["state_hash"];
  };
  const json once = hash({"--threads", "1"});
  EXPECT_EQ(hash({"--threads", "1"}), once);
  EXPECT_EQ(hash({"--threads", "2"}), once);
  EXPECT_EQ(hash({}), once);
  EXPECT_EQ(hash({"--method", "brute-force"}), once);
  EXPECT_NE(hash({"--dt", "0.02"}), once);
}

TEST(Simulate, AppliesToleranceAndFrameTime) {
  const TemporaryFolder folder;
  const auto scene = folder.write("small.toml", small_scene);
  const auto last = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"--scene", scene, "--frames", "8"});
    return simulate(more)["frames"][7];
  };
  const json plain = last({});
  EXPECT_NEAR(plain["max_speed"], 9.81 * 8 / 60, 0.15);
  EXPECT_GT(last({"--tolerance", "0.3"})["contacts"]["bodies"], plain["contacts"]["bodies"]);
  EXPECT_EQ(last({"--tolerance", "0.001"})["contacts"]["bodies"], 0);
  EXPECT_LT(last({"--dt", "0.001"})["max_speed"], 0.1) << "a shorter frame, a shorter fall";
}

const std::string two_overlap = "warning: these bodies start in a solid or in another body, and are eased out: 0 1\n";

TEST(Simulate, AppliesLevelsBucketsAndCellSize) {
  const TemporaryFolder folder;  // two balls that overlap, held, so that only detection differs
  const auto scene = folder.write("held.toml",
                                  "gravity = [0, 0, 0]\n[collision]\ntolerance = 0.1\nself_collision = false\n"
                                  "[[body]]\nrelease = 99\n[[body]]\nposition = [0.913, 3.057, 0.021]\nrelease = 99\n");
  const auto contacts = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"--scene", scene, "--frames", "1"});
    return simulate(more, two_overlap)["frames"][0]["contacts"]["bodies"].get<int>();
  };
  const std::vector<std::string> literal{"--method", "multi-level-sb"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), literal.begin(), literal.end());
    return contacts(more);
  };
  const int all = contacts({"--method", "brute-force"});
  ASSERT_GT(all, 5);
  EXPECT_EQ(with({"--buckets", "1"}), all) << "one bucket holds all boxes";
  EXPECT_LT(with({"--cell-size", "0.05", "--buckets", "16000057"}), all / 2) << "corners skip the cells between them";
  EXPECT_EQ(with({"--cell-size", "50", "--buckets", "16000057"}), all);
  EXPECT_LT(with({"--cell-size", "0.21", "--levels", "0", "--buckets", "16000057"}),
            with({"--cell-size", "0.21", "--levels", "9", "--buckets", "16000057"}))
      << "finer boxes fit the cells";
}

TEST(Simulate, AppliesPrimesAndWarnsOfPoorOnes) {
  const std::vector<std::string> no_hash{"--scene", "drop", "--frames", "1", "--primes", "1001,5,7"};
  auto poor = no_hash;
  poor.insert(poor.end(), {"--method", "grid-hash"});
  const json warnings = simulate(poor)["warnings"];
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].get<std::string>().find("prime 1001 is 0 modulo 1001"), std::string::npos) << warnings;
  auto table = poor;
  table.insert(table.begin(), "simulate");
  EXPECT_NE(run(table).out.find("note: " + warnings[0].get<std::string>()), std::string::npos);
  EXPECT_EQ(simulate(no_hash)["warnings"], json::array());
  EXPECT_EQ(simulate({"--scene", "drop", "--frames", "1"})["warnings"], json::array());
}

TEST(Simulate, WarnsOfAToleranceThatLetsVerticesThroughFaces) {
  const std::vector<std::string> low{"--scene", "drop", "--frames", "1", "--tolerance", "0.09"};
  EXPECT_EQ(simulate(low)["warnings"],
            json({"vertices can slip through faces: the tolerance is 0.09 m, below 0.094 m; see --tolerance and "
                  "--contact-surface"}));
  auto by_surfaces = low;
  by_surfaces.insert(by_surfaces.end(), {"--contact-surface", "surface"});
  EXPECT_EQ(simulate(by_surfaces)["warnings"], json::array());
}

TEST(Simulate, SaysWhichStagesActAsForcesInXpbd) {
  const std::vector<std::string> drop{"simulate", "--scene", "drop", "--frames", "1", "--integrator", "xpbd"};
  EXPECT_NE(run(drop).out.find("XPBD\n  contact-response acts as a force\nstages left out"), std::string::npos);
  EXPECT_EQ(simulate({drop.begin() + 1, drop.end()})["plan"]["as_forces"], json({"contact-response"}));
}

TEST(Simulate, AppliesTheContactSurface) {
  const auto stages = [](std::vector<std::string> more) {
    more.insert(more.end(), {"--scene", "drop", "--frames", "1"});
    const json d = simulate(more);
    return std::pair(d["plan"]["stages"].dump(), d["state_hash"]);
  };
  const auto surface = stages({"--contact-surface", "surface"}), paper = stages({"--contact-surface", "vertex-vertex"});
  EXPECT_NE(surface.first.find("surface-contact"), std::string::npos);
  EXPECT_EQ(paper.first.find("surface-contact"), std::string::npos);
  EXPECT_EQ(stages({}), paper) << "the scene's own";
}

TEST(Simulate, CountsOverlapsAndCrossingsByTheOracle) {
  const TemporaryFolder folder;  // one ball held in another, a third that flies through both in frame 2
  const auto scene = folder.write("through.toml",
                                  "gravity = [0, 0, 0]\n[[body]]\nrelease = 99\n[[body]]\nposition = [0.8, 3, 0]\n"
                                  "release = 99\n[[body]]\nposition = [0.4, 9, 0.1]\nvelocity = [0, -300, 0]\n");
  const json frames = simulate({"--scene", scene, "--frames", "2", "--oracle"}, two_overlap)["frames"];
  const json &first = frames[0]["oracle"], &second = frames[1]["oracle"];
  EXPECT_EQ(keys(first), (Keys{"penetrating_vertices", "overlapping_pairs", "self_intersecting_bodies", "deepest",
                               "mean_depth", "crossed_vertices", "edge_crossings"}));
  EXPECT_EQ(first["overlapping_pairs"], 1);
  EXPECT_GT(first["penetrating_vertices"], 10);
  EXPECT_NEAR(first["deepest"], 0.2, 0.02) << "two balls of 0.5 m, 0.8 m apart; the faces lie a little inside";
  EXPECT_GT(first["deepest"], first["mean_depth"]);
  EXPECT_EQ(first["crossed_vertices"], 0) << "it is still above them";
  EXPECT_GT(second["crossed_vertices"], 100);
  EXPECT_GT(second["edge_crossings"], 100);
  EXPECT_EQ(second["penetrating_vertices"], first["penetrating_vertices"]) << "and below them after";
}

/// Returns a closed OBJ mesh of 1,162 vertices around the origin: more than are simulated.
std::string fine_ball() {
  constexpr int rings = 30, across = 40;
  std::ostringstream vertices, faces;
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j < across; ++j) {
      const double polar = M_PI * i / rings, around = 2 * M_PI * j / across;
      const int k = across * i + j + 1, next = across * i + (j + 1) % across + 1;
      vertices << "v " << std::sin(polar) * std::cos(around) << ' ' << std::cos(polar) << ' '
               << std::sin(polar) * std::sin(around) << '\n';
      if (i < rings) faces << "f " << k << ' ' << next << ' ' << next + across << ' ' << k + across << '\n';
    }
  return vertices.str() + faces.str();
}

TEST(SimulateJsonLines, CountByTheOracleWhatIsSimulatedOfFineMeshes) {
  const TemporaryFolder folder;  // a ball that is held inside another
  folder.write("ball.obj", fine_ball());
  const std::string body = "[[body]]\nrelease = 99\nmesh = {kind = \"file\", path = \"ball.obj\", size = ";
  const auto scene = folder.write("within.toml", body + "2}\n" + body + "0.5, resolution = 200}\n");
  const Outcome o = run({"simulate", "--scene", scene, "--frames", "2", "--oracle", "--json-lines"});
  EXPECT_EQ(o.status, 0);
  const std::regex remark("simulated by ([0-9]+) particles");
  const std::vector<std::smatch> remarks{std::sregex_iterator(o.err.begin(), o.err.end(), remark), {}};
  ASSERT_EQ(remarks.size(), 2u) << o.err;
  const int particles = std::stoi(remarks[1][1]);
  EXPECT_NEAR(particles, 200, 20);
  const std::vector<json> lines = parse_lines(o.out);
  ASSERT_EQ(lines.size(), 3u);
  for (const int frame : {0, 1}) {
    const json& found = lines[static_cast<std::size_t>(frame)]["oracle"];
    EXPECT_EQ(found["penetrating_vertices"], particles) << "all of the inner ball, none of its fine mesh";
    EXPECT_EQ(found["overlapping_pairs"], 1);
    EXPECT_EQ(found["self_intersecting_bodies"], 0);
    EXPECT_EQ(found["crossed_vertices"], 0);
  }
}

TEST(Simulate, PrintsAShortTableWithoutJson) {
  const Outcome o = run({"simulate", "--scene", "drop", "--frames", "100"});
  EXPECT_EQ(o.status, 0);
  EXPECT_EQ(o.err, "") << "progress is for terminals";
  EXPECT_NE(
      o.out.find("state hash " + simulate({"--scene", "drop", "--frames", "100"})["state_hash"].get<std::string>()),
      std::string::npos);
  EXPECT_LT(std::count(o.out.begin(), o.out.end(), '\n'), 40);
}

TEST(Simulate, RunsInAnyFolderAndWithoutADisplay) {
  const TemporaryFolder folder;
  folder.write("here.toml", small_scene);
  unsetenv("DISPLAY");
  EXPECT_EQ(run({"simulate", "--scene", "here.toml", "--frames", "2", "--json"}, folder.path()).status, 0);
  EXPECT_EQ(run({"simulate", "--scene", "drop", "--frames", "2", "--json"}, folder.path()).status, 0);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1) << "nothing was written";
}

}  // namespace THIS_FILE
}  // namespace cli::test
