// The JSON document of `simulate`, and the effect of the options.

#include <fcntl.h>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <regex>
#include <set>
#include <sstream>

#include "softbody/mesh/mesh.h"
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

/// Two worlds side by side are two runs.
TEST(Simulate, RunsASecondWorldBesideTheFirst) {
  const Words plain{"--scene", "drop", "--frames", "40", "--levels", "2"};
  const json both = simulate(with(plain, {"--beside", "method=multi-level-sb,cell-size=0.3,0.2,0.3,integrator=rk4"}));
  const json first = simulate(plain), second = simulate(with(plain, {"--method", "multi-level-sb", "--cell-size",
                                                                     "0.3,0.2,0.3", "--integrator", "rk4"}));
  EXPECT_EQ(both["state_hash"], first["state_hash"]);
  EXPECT_EQ(keys(both["beside"]), keys(second));
  for (const char* key : {"method", "integrator", "state_hash"}) EXPECT_EQ(both["beside"][key], second[key]) << key;
  EXPECT_EQ(both["beside"]["frames"].size(), 40u);
  const std::string text =
      run({"simulate", "--scene", "A", "--frames", "60", "--beside", "method=multi-level-sb,cell-size=0.1"}).out;
  EXPECT_TRUE(std::regex_search(text, std::regex("\nmissed 0 of [1-9][^]*\nbeside it[^]*\nmissed [1-9]"))) << text;
  const Outcome lines =
      run({"simulate", "--scene", "drop", "--frames", "2", "--json-lines", "--oracle", "--beside", "method=grid-hash"});
  ASSERT_EQ(lines.status, 0) << lines.err;
  const json line = json::parse(lines.out.substr(0, lines.out.find('\n')));
  EXPECT_EQ(line["beside"]["frame"], 1);
  EXPECT_TRUE(line["beside"].contains("oracle"));
}

TEST(Simulate, PrintsOneDocumentOfTheContractsForm) {
  const json d = simulate({"--scene", "drop", "--frames", "010"});
  EXPECT_EQ(keys(d), (Keys{"scene", "method", "integrator", "plan", "warnings", "frames", "state_hash"}));
  EXPECT_EQ(d["scene"], "drop");
  EXPECT_EQ(d["method"], "multi-level-sb-exact");
  EXPECT_EQ(d["integrator"]["key"], "auto");
  EXPECT_EQ(d["warnings"], json::array());
  EXPECT_TRUE(std::regex_match(d["state_hash"].get<std::string>(), std::regex("[0-9a-f]{16}")));
  ASSERT_EQ(d["frames"].size(), 10u) << "leading zeros are decimal";
  for (std::size_t i = 0; i < 10; ++i) {
    const json& f = d["frames"][i];
    EXPECT_EQ(keys(f), (Keys{"frame", "time", "ms", "contacts", "energy", "energies", "volume_ratio",
                             "deepest_penetration", "max_speed", "finite"}));
    EXPECT_EQ(f["frame"], i + 1) << "frame n is the state after n steps";
    for (const auto& [object, names] :
         std::vector<std::pair<std::string, Keys>>{{"ms", {"detect", "solve", "total"}},
                                                   {"contacts", {"bodies", "self", "solid"}},
                                                   {"energies", {"kinetic", "elastic", "gas", "gravity"}},
                                                   {"volume_ratio", {"min", "max"}}}) {
      EXPECT_EQ(keys(f[object]), names);
      for (const json& number : f[object])
        EXPECT_TRUE(object == "contacts" ? number.is_number_unsigned() : number.is_number()) << object;
    }
    EXPECT_GE(f["deepest_penetration"], 0.0);
    EXPECT_EQ(f["finite"], true);
    EXPECT_NEAR(f["volume_ratio"]["min"], 1, 1e-3);
  }
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
  EXPECT_EQ(all, (Keys{"arrive",
                       "hold",
                       "air-drag",
                       "contact-response",
                       "surface-contact",
                       "structural-springs",
                       "bend-springs",
                       "shear-springs",
                       "gas-pressure",
                       "shape-matching",
                       "grab",
                       "gravity",
                       "integrate",
                       "restitution",
                       "solids",
                       "solid-features",
                       "internal-damping",
                       "rebound-damping",
                       "rolling-resistance",
                       "detect",
                       "sleep"}));
  const auto runs = [&](const char* stage) {
    return std::find(plan["stages"].begin(), plan["stages"].end(), stage) != plan["stages"].end();
  };
  EXPECT_TRUE(runs("solids") && runs("gas-pressure") && runs("detect"));
  EXPECT_EQ(plan["shapes"], json::array({"ground"}));
  EXPECT_FALSE(runs("arrive") || runs("shear-springs"));
}

TEST(Simulate, PrintsFiguresThatAgreeWithPhysics) {
  const TemporaryFolder folder;
  const auto fall = folder.write("fall.toml",
                                 "[collision]\nself_collision = false\n[[material]]\nmass = 2\n[[body]]\n"
                                 "position = [0, 50, 0]\nvelocity = [3, 0, 0]\n[ground]\n");
  const json last = simulate({"--scene", fall, "--frames", "60"})["frames"][59];
  EXPECT_NEAR(last["max_speed"], std::hypot(3, 9.81), 1e-3) << "after a second";
  EXPECT_NEAR(last["energy"], 2 * 9.81 * 50 + 0.5 * 2 * 9, 10) << "joules: potential and kinetic";
  EXPECT_EQ(last["contacts"], json({{"bodies", 0}, {"self", 0}, {"solid", 0}}));
  EXPECT_EQ(last["deepest_penetration"], 0.0);
  const json small = simulate({"--scene", folder.write("small.toml", small_scene), "--frames", "20"});
  for (const json& frame : small["frames"]) {
    double sum = 0;
    for (const json& part : frame["energies"]) sum += part.get<double>();
    EXPECT_NEAR(sum, frame["energy"], 1e-9 * std::abs(sum));
    EXPECT_GT(frame["energies"]["kinetic"], 0.0);
    EXPECT_GT(frame["energies"]["elastic"], 0.0) << "the gas stretches the springs from the start";
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
  const Words arguments{"--scene", folder.write("small.toml", small_scene), "--frames", "15", "--oracle"};
  json document = simulate(arguments);
  const Outcome o = run(with({"simulate", "--json-lines"}, arguments));
  EXPECT_EQ(o.status, 0);
  EXPECT_EQ(o.err, "");
  std::vector<json> lines = parse_lines(o.out);
  ASSERT_EQ(lines.size(), 16u);
  for (std::size_t i = 0; i < 15; ++i) {
    for (json* frame : {&lines[i], &document["frames"][i]}) EXPECT_EQ(frame->erase("ms"), 1u);
    EXPECT_EQ(lines[i], document["frames"][i]);
  }
  document.erase("frames");
  EXPECT_EQ(lines.back(), document);
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

TEST(SimulateJsonLines, ArriveWholeWhileTheRunLastsAndEndItWhenTheReaderEnds) {
  const TemporaryFolder folder;
  const std::string pipe = folder.path() / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  ASSERT_GE(reader, 0);
  Process process({"simulate", "--scene", "drop", "--frames", "10000000", "--json-lines"}, "/", {}, pipe);
  std::string lines;
  while (std::ranges::count(lines, '\n') < 3) {
    pollfd arrival{.fd = reader, .events = POLLIN, .revents = 0};
    ASSERT_EQ(poll(&arrival, 1, 60'000), 1) << "nothing was printed";
    std::array<char, 65'536> part;
    const ssize_t size = read(reader, part.data(), part.size());
    ASSERT_GT(size, 0);
    lines.append(part.data(), static_cast<std::size_t>(size));
    EXPECT_TRUE(lines.ends_with('\n')) << "whole lines";
  }
  EXPECT_EQ(parse_lines(lines)[2]["frame"], 3);
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
  const auto hash = [](const Words& more) {
    return simulate(with({"--scene", "drop", "--frames", "260"}, more))["state_hash"];
  };
  const json once = hash({"--threads", "1"});
  EXPECT_EQ(hash({"--threads", "1"}), once);
  EXPECT_EQ(hash({"--threads", "2"}), once);
  EXPECT_EQ(hash({}), once);
  EXPECT_EQ(hash({"--method", "brute-force"}), once);
  EXPECT_NE(hash({"--dt", "0.02"}), once);
}

const std::string two_overlap = "warning: these bodies start in a solid or in another body, and are eased out: 0 1\n";

TEST(Simulate, WarnsOfPoorPrimesAndOfAToleranceThatLetsVerticesThroughFaces) {
  const Words low{"--scene", "drop", "--frames", "1", "--tolerance", "0.09"},
      poor = with(low, {"--method", "grid-hash", "--primes", "1001,5,7"});
  const std::string lost = "prime 1001 is 0 modulo 1001 buckets, so its axis is lost",
                    slip =
                        "vertices can slip through faces: the tolerance is 0.09 m, below 0.094 m; see --tolerance "
                        "and --contact-surface";
  EXPECT_EQ(simulate(poor)["warnings"], json({lost, slip}));
  EXPECT_NE(run(with({"simulate"}, poor)).out.find("note: " + lost + "\nnote: " + slip), std::string::npos);
  EXPECT_EQ(simulate(with(low, {"--contact-surface", "surface", "--primes", "1001,5,7"}))["warnings"], json::array());
}

TEST(Simulate, SaysWhichStagesActAsForcesInXpbd) {
  const Words xpbd{"--scene", "drop", "--frames", "1", "--integrator", "xpbd"};
  EXPECT_NE(run(with({"simulate"}, xpbd)).out.find("XPBD\n  contact-response acts as a force\nstages left out"),
            std::string::npos);
  EXPECT_EQ(simulate(xpbd)["plan"]["as_forces"], json({"contact-response"}));
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

/// Returns a closed OBJ mesh of 2,562 vertices around the origin: more than are simulated.
std::string fine_ball() {
  const softbody::Mesh ball = softbody::icosphere(4, 1);
  std::string text;
  for (const glm::dvec3& v : ball.vertices) text += fmt::format("v {} {} {}\n", v.x, v.y, v.z);
  for (const auto& [a, b, c] : ball.triangles) text += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
  return text;
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
  const Words sixty{"--scene", "B", "--frames", "60"};
  const Outcome o = run(with({"simulate"}, sixty));
  EXPECT_EQ(o.status, 0);
  EXPECT_EQ(o.err, "") << "progress is for terminals";
  const json d = simulate(sixty), f = d["frames"][59];
  const auto number = [&](const char* path) { return f.at(json::json_pointer(path)).get<double>(); };
  const std::string row =
      fmt::format("{:9.0f} {:7.0f} {:7.0f} {:12.4f} {:7.3f} {:7.3f} {:12.2e} {:10.4f}\n", number("/contacts/bodies"),
                  number("/contacts/self"), number("/contacts/solid"), number("/energy"), number("/volume_ratio/min"),
                  number("/volume_ratio/max"), number("/deepest_penetration"), number("/max_speed"));
  EXPECT_NE(o.out.find(row), std::string::npos) << row << o.out;
  EXPECT_NE(o.out.find("state hash " + d["state_hash"].get<std::string>()), std::string::npos);
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
