// Compares the contacts of `detect` with a plain double loop, and checks the form of its output.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "tests/cli/detect_rig.h"

namespace cli::test {
namespace THIS_FILE {

using nlohmann::json;

/// A folder with files for `detect`, and shorthands to run it on them.
class Detect : public testing::Test {
 protected:
  std::string file(const std::string& name, const State& state) { return folder.write(name, state.obj()); }
  std::string csv() const { return folder.path() / "contacts.csv"; }
  std::vector<ContactRow> contacts(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--contacts", csv()});
    figures = detect(arguments);
    return read_contacts(csv());
  }

  TemporaryFolder folder;
  json figures;  // what the last contacts() printed
};

constexpr const char* exact[]{"brute-force", "grid-hash", "bounding-box", "bounding-box-grid-hash",
                              "multi-level-sb-exact"};

TEST_F(Detect, FindsTheSameAsADoubleLoopByExactMethods) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const State state = random_state(seed);
    const std::string obj = file("state.obj", state);
    for (const char* tolerance : {"0.05", "0.12"}) {
      const auto expected = oracle(0, state, {.tolerance = std::strtof(tolerance, nullptr)});
      ASSERT_GT(expected.size(), 20u);
      const auto self = std::ranges::count_if(expected, [](const ContactRow& r) { return r.body_a == r.body_b; });
      for (const std::string method : exact) {
        for (const char* threads : {"1", "2"}) {
          EXPECT_EQ(contacts({obj, "--tolerance", tolerance, "--method", method, "--threads", threads}), expected)
              << method << ", tolerance " << tolerance << ", seed " << seed << ", threads " << threads;
          EXPECT_EQ(figures["frames"][0]["contacts"], expected.size());
          EXPECT_EQ(figures["frames"][0]["self_contacts"], self);
        }
      }
    }
  }
}

TEST_F(Detect, FindsASubsetByTheLiteralMethod) {
  const State state = random_state(4);
  const std::string obj = file("state.obj", state);
  const auto expected = oracle(0, state, {.tolerance = 0.09f});
  const auto literal = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {obj, "--tolerance", "0.09", "--method", "multi-level-sb"});
    const auto found = contacts(more);
    EXPECT_TRUE(std::ranges::includes(expected, found));
    return found.size();
  };
  EXPECT_GT(literal({}), 0u);
  EXPECT_EQ(literal({"--buckets", "1"}), expected.size()) << "one bucket holds all boxes";
  EXPECT_LT(literal({"--cell-size", "0.02", "--buckets", "16000057"}), expected.size()) << "corners skip cells";
}

TEST_F(Detect, FindsTheSameForAllHashSettingsByExactMethods) {
  const State state = random_state(5);
  const std::string obj = file("state.obj", state);
  const auto expected = oracle(0, state, {.tolerance = 0.06f});
  for (const std::string method : exact) {
    for (const std::vector<std::string>& more : {std::vector<std::string>{"--levels", "0"},
                                                 {"--levels", "9"},
                                                 {"--levels", "15"},
                                                 {"--buckets", "1"},
                                                 {"--buckets", "16777216"},
                                                 {"--primes", "1001,1,1"},
                                                 {"--cell-size", "0.011"},
                                                 {"--cell-size", "1000"}}) {
      std::vector<std::string> arguments{obj, "--tolerance", "0.06", "--method", method};
      arguments.insert(arguments.end(), more.begin(), more.end());
      EXPECT_EQ(contacts(arguments), expected) << method << " " << more[0] << " " << more[1];
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
    const std::vector<std::string> base{obj, "--tolerance", "0.09", "--method", method};
    const auto with = [&](std::vector<std::string> more) {
      more.insert(more.begin(), base.begin(), base.end());
      return contacts(more);
    };
    EXPECT_EQ(with({"--self"}), all) << method;
    EXPECT_EQ(with({"--no-self"}), none) << method;
    EXPECT_EQ(with({"--self", "--no-self"}), none) << "the last one holds";
    EXPECT_EQ(with({"--no-self", "--self"}), all) << "the last one holds";
    EXPECT_EQ(with({"--rest", rest_obj}), some) << method;
  }
}

TEST_F(Detect, LeavesOutPolygonEdgesButNotDiagonals) {
  const auto quad = folder.write("quad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  const auto found = contacts({quad, "--tolerance", "2"});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0], (ContactRow{0, 0, 2, 0, 0, std::sqrt(2.0f)}));
  EXPECT_EQ(found[1], (ContactRow{0, 1, 3, 0, 0, std::sqrt(2.0f)}));
  EXPECT_EQ(contacts({quad, "--tolerance", "1.4142"}).size(), 0u);
}

TEST_F(Detect, UsesTheEdgesOfTheFirstFileInAllFrames) {
  const State first = random_state(8), second = moved(first, 0.05f, 9), third = moved(first, 0.1f, 10);
  const std::vector<std::string> base{file("1.obj", first), file("2.obj", second), file("3.obj", third), "--tolerance",
                                      "0.07"};
  auto expected = oracle(0, first, {.tolerance = 0.07f});
  for (const auto& [number, state] : {std::pair(1u, &second), std::pair(2u, &third)}) {
    const auto rows = oracle(number, *state, {.tolerance = 0.07f, .edges = &first});
    expected.insert(expected.end(), rows.begin(), rows.end());
  }
  for (const std::string method : exact) {
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{}, {"--repeat", "3"}, {"--no-reuse"}, {"--no-reuse", "--repeat", "2"}}) {
      std::vector<std::string> arguments = base;
      arguments.insert(arguments.end(), {"--method", method});
      arguments.insert(arguments.end(), more.begin(), more.end());
      EXPECT_EQ(contacts(arguments), expected) << method;
      EXPECT_EQ(figures["frames"].size(), 3u);
    }
  }
}

TEST_F(Detect, PrintsJsonOfTheContractsForm) {
  const State state = random_state(11);
  const std::string obj = file("state.obj", state);
  const json d = detect({obj, obj, "--tolerance", "0.0375", "--threads", "2", "--repeat", "4"});
  const auto keys = [](const json& object) {
    std::vector<std::string> names;
    for (const auto& [key, value] : object.items()) names.push_back(key);
    std::ranges::sort(names);
    return names;
  };
  using Keys = std::vector<std::string>;
  EXPECT_EQ(keys(d), (Keys{"bodies", "cell_size", "frames", "method", "threads", "tolerance", "vertices", "warnings"}));
  EXPECT_EQ(d["method"], "multi-level-sb-exact");
  EXPECT_EQ(d["tolerance"], 0.0375);
  EXPECT_EQ(d["threads"], 2);
  EXPECT_EQ(d["bodies"], state.bodies.size());
  std::size_t vertices = 0;
  for (const Body& body : state.bodies) vertices += body.vertices.size();
  EXPECT_EQ(d["vertices"], vertices);
  ASSERT_EQ(d["frames"].size(), 2u);
  for (std::size_t f = 0; f < 2; ++f) {
    const json& frame = d["frames"][f];
    EXPECT_EQ(keys(frame),
              (Keys{"boxes", "contacts", "frame", "hashes", "ms", "pair_tests", "self_contacts", "skipped"}));
    EXPECT_EQ(frame["frame"], f) << "counted from 0";
    for (const char* key : {"boxes", "contacts", "hashes", "pair_tests", "self_contacts"})
      EXPECT_TRUE(frame[key].is_number_unsigned()) << key;
    EXPECT_GT(frame["pair_tests"], 0);
    EXPECT_TRUE(frame["skipped"].is_object());
    EXPECT_EQ(keys(frame["ms"]), (Keys{"median", "min"}));
    EXPECT_GT(frame["ms"]["min"], 0.0);
    EXPECT_LE(frame["ms"]["min"], frame["ms"]["median"]);
  }
}

TEST_F(Detect, TakesTheCellSizeFromTheBodiesAtRestElseFromTheFirstFrame) {
  const auto box = [](float side) {
    Body body;
    for (const float at : {0.0f, side}) body.vertices.insert(body.vertices.end(), {{at, 0, 0}, {0, at, 0}, {0, 0, at}});
    return State{{body}};
  };
  const std::string first = file("first.obj", box(2)), later = file("later.obj", box(8)),
                    rest = file("rest.obj", box(4));
  const auto cell = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--tolerance", "0.25", "--levels", "0"});
    return detect(arguments)["cell_size"].get<std::vector<double>>();
  };
  EXPECT_EQ(cell({first, later}), std::vector<double>(3, 2.25));
  EXPECT_EQ(cell({first, later, "--rest", rest}), std::vector<double>(3, 4.25));
  EXPECT_EQ(cell({first, later, "--rest", rest, "--cell-size", "1,2,3"}), (std::vector<double>{1, 2, 3}));
  const json all = detect({first, "--rest", rest, "--tolerance", "0.25", "--levels", "0", "--method", "all"});
  for (const json& method : all) EXPECT_EQ(method["cell_size"], (std::vector<double>(3, 4.25)));
}

TEST_F(Detect, WarnsOfPrimesThatSpoilTheHash) {
  const std::string obj = file("state.obj", random_state(14));
  const std::vector<std::string> no_hash{obj, "--tolerance", "0.05", "--primes", "2002,5,1006"};
  auto base = no_hash;
  base.insert(base.end(), {"--method", "multi-level-sb"});
  const json spoilt = detect(base)["warnings"];
  ASSERT_EQ(spoilt.size(), 1u);
  EXPECT_NE(spoilt[0].get<std::string>().find("prime 2002 is 0 modulo 1001"), std::string::npos) << spoilt;
  EXPECT_NE(spoilt[0].get<std::string>().find("primes 5 and 1006 are equal"), std::string::npos) << spoilt;
  auto other_count = base;
  other_count.insert(other_count.end(), {"--buckets", "997"});
  EXPECT_EQ(detect(no_hash)["warnings"], json::array());
  EXPECT_EQ(detect(other_count)["warnings"], json::array());
}

TEST_F(Detect, ReadsLineEndsOfAnySystem) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const std::string text = "o a" + end + "v 0 0 0" + end + "v .01 0 0" + end + "o b" + end + "v .02 0 0" + end;
    for (const std::string padding : {"", "\x1a"}) {
      const json d = detect({folder.write("a.obj", text + padding), "--tolerance", "0.1"});
      EXPECT_EQ(d["bodies"], 2);
      EXPECT_EQ(d["frames"][0]["contacts"], 3);
      EXPECT_EQ(d["frames"][0]["self_contacts"], 1);
    }
  }
}

TEST_F(Detect, WarnsOfFilesThatMayMeanSomethingElse) {
  const std::string mesh = "v 0 0 0 2\nv 1 0 0\nv 2 0 0\no a\nf 1 2 3\no b\nf 1 2 3\n";
  const std::string obj = folder.write("a.obj", mesh);
  const json warnings = detect({obj, "--tolerance", "1"})["warnings"];
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[0].get<std::string>().find("2 objects have faces"), std::string::npos) << warnings;
  EXPECT_NE(warnings[1].get<std::string>().find("weight"), std::string::npos) << warnings;
  const Outcome table = run({"detect", obj, "--tolerance", "1"});
  EXPECT_NE(table.out.find("note: 2 objects have faces"), std::string::npos) << table.out;
}

TEST_F(Detect, TestsEveryPairByBruteForce) {
  const auto three = folder.write("three.obj", "v 0 0 0\nv 9 0 0\no b\nv 0 9 0\n");
  const json frame = detect({three, "--tolerance", "1", "--method", "brute-force"})["frames"][0];
  EXPECT_EQ(frame["pair_tests"], 3);
  EXPECT_EQ(frame["hashes"], 0);
}

TEST_F(Detect, CountsBodiesWithoutVertices) {
  const auto empty = folder.write("empty.obj", "o nothing\no nothing\n");
  const json d = detect({empty, "--tolerance", "1"});
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
  const Outcome one_bucket = run({"detect", obj, "--tolerance", "0.09", "--buckets", "1", "--method", "grid-hash"});
  EXPECT_NE(one_bucket.out.find("note: prime"), std::string::npos) << "a poor hash is said to be one";
}

TEST_F(Detect, WritesOnlyTheContactsFileAndReplacesAnEarlierOne) {
  const State state = random_state(13);
  const std::string obj = file("state.obj", state);
  for (const char* tolerance : {"0.08", "0.05"}) contacts({obj, "--tolerance", tolerance});
  EXPECT_EQ(read_contacts(csv()), oracle(0, state, {.tolerance = 0.05f}));
  EXPECT_EQ(file_names(folder.path()), (std::set<std::string>{"contacts.csv", "state.obj"}));
}

}  // namespace THIS_FILE
}  // namespace cli::test
