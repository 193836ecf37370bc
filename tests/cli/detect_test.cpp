// Compares the contacts of `detect` with a plain double loop, and checks the form of its output.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "tests/cli/detect_rig.h"

namespace cli::test {
namespace THIS_FILE {

using nlohmann::json;

using Detect = DetectFolder;

constexpr const char* exact[]{"brute-force", "grid-hash", "bounding-box", "bounding-box-grid-hash",
                              "multi-level-sb-exact"};

TEST_F(Detect, FindsTheSameAsADoubleLoopByExactMethodsWithAnyOptions) {
  const State state = random_state(1);
  const std::string obj = file("state.obj", state);
  for (const char* tolerance : {"0.05", "0.12"}) {
    const auto expected = oracle(0, state, {.tolerance = std::strtof(tolerance, nullptr)});
    ASSERT_GT(expected.size(), 20u);
    const auto self = std::ranges::count_if(expected, [](const ContactRow& r) { return r.body_a == r.body_b; });
    for (const std::string method : exact) {
      for (const Words& more : {Words{"--threads", "1"},
                                {"--threads", "2", "--levels", "9"},
                                {"--buckets", "1", "--levels", "0"},
                                {"--primes", "1001,1,1", "--cell-size", "0.011"}}) {
        EXPECT_EQ(contacts(with({obj, "--tolerance", tolerance, "--method", method}, more)), expected)
            << method << ", tolerance " << tolerance << ", " << more[0];
        EXPECT_EQ(figures["frames"][0]["contacts"], expected.size());
        EXPECT_EQ(figures["frames"][0]["self_contacts"], self);
      }
    }
  }
}

TEST_F(Detect, LeavesOutPairsByTheOptionsSelfAndRest) {
  const State rest = random_state(6), state = moved(rest, 0.05f, 7);
  State with_faces = state;
  for (std::size_t b = 0; b < rest.bodies.size(); ++b) with_faces.bodies[b].faces = rest.bodies[b].faces;
  const std::string obj = file("state.obj", with_faces), rest_obj = file("rest.obj", rest);
  const auto all = oracle(0, with_faces, {.tolerance = 0.09f});
  const auto none = oracle(0, with_faces, {.tolerance = 0.09f, .self = false});
  const auto some = oracle(0, with_faces, {.tolerance = 0.09f, .rest = &rest});
  ASSERT_GT(all.size(), some.size());
  ASSERT_GT(some.size(), none.size());
  for (const std::string method : exact) {
    const auto found = [&](const Words& more) {
      return contacts(with({obj, "--tolerance", "0.09", "--method", method}, more));
    };
    EXPECT_EQ(found({"--self", "--no-self"}), none) << method << ": the last one holds";
    EXPECT_EQ(found({"--no-self", "--self"}), all) << method << ": the last one holds";
    EXPECT_EQ(found({"--rest", rest_obj}), some) << method;
  }
}

TEST_F(Detect, LeavesOutPolygonEdgesButNotDiagonals) {
  const auto quad = folder.write("quad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  const ContactRow one{0, 0, 2, 0, 0, std::sqrt(2.0f)}, other{0, 1, 3, 0, 0, std::sqrt(2.0f)};
  EXPECT_EQ(contacts({quad, "--tolerance", "2"}), (std::vector{one, other}));
  EXPECT_EQ(contacts({quad, "--tolerance", "1.4142"}).size(), 0u);
}

TEST_F(Detect, UsesTheEdgesOfTheFirstFileInAllFrames) {
  const State first = random_state(8), second = moved(first, 0.05f, 9), third = moved(first, 0.1f, 10);
  const Words files{file("1.obj", first), file("2.obj", second), file("3.obj", third), "--tolerance", "0.07"};
  auto expected = oracle(0, first, {.tolerance = 0.07f});
  for (const auto& [number, state] : {std::pair(1u, &second), std::pair(2u, &third)}) {
    const auto rows = oracle(number, *state, {.tolerance = 0.07f, .edges = &first});
    expected.insert(expected.end(), rows.begin(), rows.end());
  }
  for (const std::string method : exact) {
    for (const Words& more : {Words{}, {"--repeat", "3"}, {"--no-reuse", "--repeat", "2"}}) {
      EXPECT_EQ(contacts(with(with(files, {"--method", method}), more)), expected) << method;
      EXPECT_EQ(figures["frames"].size(), 3u);
    }
  }
}

TEST_F(Detect, PrintsJsonOfTheContractsForm) {
  const auto three = folder.write("three.obj", "v 0 0 0\nv 9 0 0\no b\nv 0 .01 0\n");
  json d = detect({three, three, "--tolerance", "0.0375", "--threads", "2", "--repeat", "4", "--cell-size", "1,2,4",
                   "--method", "brute-force"});
  for (json& frame : d["frames"]) {
    EXPECT_GT(frame["ms"]["min"], 0.0);
    EXPECT_LE(frame["ms"]["min"], frame["ms"]["median"]);
    EXPECT_EQ(frame["ms"].size(), 2u);
    EXPECT_TRUE(frame["skipped"].is_object());
    for (const char* key : {"ms", "skipped"}) frame.erase(key);
  }
  const auto frame = [](int number) {
    return json{{"frame", number}, {"contacts", 1}, {"self_contacts", 0},
                {"pair_tests", 3}, {"hashes", 0},   {"boxes", 0}};
  };
  EXPECT_EQ(d, (json{{"method", "brute-force"},
                     {"tolerance", 0.0375},
                     {"cell_size", {1.0, 2.0, 4.0}},
                     {"threads", 2},
                     {"bodies", 2},
                     {"vertices", 3},
                     {"warnings", json::array()},
                     {"frames", {frame(0), frame(1)}}}));
}

TEST_F(Detect, TakesTheCellSizeFromTheBodiesAtRestElseFromTheFirstFrame) {
  const auto box = [](float side) {
    Body body;
    for (const float at : {0.0f, side}) body.vertices.insert(body.vertices.end(), {{at, 0, 0}, {0, at, 0}, {0, 0, at}});
    return State{{body}};
  };
  const std::string first = file("first.obj", box(2)), later = file("later.obj", box(8)),
                    rest = file("rest.obj", box(4));
  const Words levels{"--tolerance", "0.25", "--levels", "0"};
  EXPECT_EQ(detect(with({first, later}, levels))["cell_size"], json({2.25, 2.25, 2.25}));
  EXPECT_EQ(detect(with({first, later, "--rest", rest}, levels))["cell_size"], json({4.25, 4.25, 4.25}));
  for (const json& method : detect(with({first, "--rest", rest, "--method", "all"}, levels)))
    EXPECT_EQ(method["cell_size"], json({4.25, 4.25, 4.25}));
}

TEST_F(Detect, WarnsOfPrimesAndFilesThatMayMeanSomethingElse) {
  const std::string obj = folder.write("a.obj", "v 0 0 0 2\nv 1 0 0\nv 2 0 0\no a\nf 1 2 3\no b\nf 1 2 3\n");
  const Words poor{obj, "--tolerance", "1", "--primes", "1001,5,7", "--method", "grid-hash"};
  const json warnings = detect(poor)["warnings"];
  ASSERT_EQ(warnings.size(), 3u);
  const std::string table = run(with({"detect"}, poor)).out;
  for (const auto& [i, words] :
       {std::pair(0, "prime 1001 is 0 modulo 1001"), {1, "2 objects have faces"}, {2, "weight"}}) {
    const std::string warning = warnings[static_cast<std::size_t>(i)];
    EXPECT_NE(warning.find(words), std::string::npos) << warning;
    EXPECT_NE(table.find("note: " + warning), std::string::npos) << table;
  }
  EXPECT_EQ(detect(with(poor, {"--buckets", "997"}))["warnings"].size(), 2u) << "they spoil another hash";
}

TEST_F(Detect, CountsBodiesWithoutVertices) {
  const json d = detect({folder.write("empty.obj", "o nothing\no nothing\n"), "--tolerance", "1"});
  EXPECT_EQ(d["bodies"], 2);
  EXPECT_EQ(d["vertices"], 0);
  EXPECT_EQ(d["frames"][0]["contacts"], 0);
}

TEST_F(Detect, PrintsAShortTableWithoutJson) {
  const std::string obj = file("state.obj", random_state(12));
  const Outcome o = run({"detect", obj, obj, "--tolerance", "0.09"});
  EXPECT_EQ(o.status, 0);
  EXPECT_EQ(o.err, "");
  EXPECT_EQ(std::ranges::count(o.out, '\n'), 4) << o.out;
  const json d = detect({obj, "--tolerance", "0.09"});
  for (const char* key : {"contacts", "self_contacts", "pair_tests", "hashes", "boxes"})
    EXPECT_NE(o.out.find(d["frames"][0][key].dump()), std::string::npos) << key;
}

}  // namespace THIS_FILE
}  // namespace cli::test
