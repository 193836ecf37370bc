// `detect` with what a body is left to the user, and with all methods side by side.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <random>

#include "collide/methods.h"
#include "tests/cli/detect_rig.h"
#include "tests/cli/ply_rig.h"

namespace cli::test {
namespace THIS_FILE {

using nlohmann::json;

class DetectBodies : public testing::Test {
 protected:
  std::string csv() const { return folder.path() / "contacts.csv"; }
  std::vector<ContactRow> contacts(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--contacts", csv()});
    detect(arguments);
    return read_contacts(csv());
  }
  TemporaryFolder folder;
};

/// A state whose vertices are scattered over its file.
struct Scattered {
  std::vector<std::array<float, 3>> vertices;
  std::vector<std::vector<unsigned>> faces;
  std::vector<unsigned> place;  // by vertex of the state: its number in the file

  Scattered(const State& state, unsigned seed) {
    std::size_t count = 0;
    for (const Body& body : state.bodies) count += body.vertices.size();
    place.resize(count);
    std::iota(place.begin(), place.end(), 0u);
    std::mt19937 random(seed);
    std::ranges::shuffle(place, random);
    vertices.resize(count);
    std::size_t base = 0;
    for (const Body& body : state.bodies) {
      for (const auto& face : body.faces) {
        faces.emplace_back();
        for (const unsigned corner : face) faces.back().push_back(place[base + corner]);
      }
      for (const auto& vertex : body.vertices) vertices[place[base++]] = vertex;
    }
    std::ranges::shuffle(faces, random);
  }

  /// Returns contacts of the state as those of the file. Its bodies are in the order of their first vertices, and those
  /// without a face are the last one.
  std::vector<ContactRow> rows(std::vector<ContactRow> of_state, const State& state) const {
    std::vector<unsigned> body_of, first(state.bodies.size(), ~0u);
    for (unsigned b = 0; b < state.bodies.size(); ++b)
      body_of.insert(body_of.end(), state.bodies[b].vertices.size(), b);
    for (std::size_t v = 0; v < body_of.size(); ++v)
      if (const unsigned b = body_of[v]; !state.bodies[b].faces.empty()) first[b] = std::min(first[b], place[v]);
    const auto rank = [&](unsigned body) {
      return static_cast<unsigned>(std::ranges::count_if(first, [&](unsigned other) { return other < first[body]; }));
    };
    for (ContactRow& row : of_state) {
      row = {row.frame, place[row.vertex_a], place[row.vertex_b], rank(row.body_a), rank(row.body_b), row.distance};
      if (row.vertex_a < row.vertex_b) continue;
      std::swap(row.vertex_a, row.vertex_b);
      std::swap(row.body_a, row.body_b);
    }
    std::ranges::sort(of_state);
    return of_state;
  }
};

TEST_F(DetectBodies, NamesVerticesAsTheFileDoes) {
  const State state = random_state(3), next = moved(state, 0.05f, 5);
  const Scattered first(state, 1), second(next, 1);
  auto expected = first.rows(oracle(0, state, {.tolerance = 0.07f}), state);
  const auto later = first.rows(oracle(1, next, {.tolerance = 0.07f, .edges = &state}), state);
  expected.insert(expected.end(), later.begin(), later.end());
  ASSERT_GT(std::ranges::count_if(expected, [](const ContactRow& r) { return r.body_a != r.body_b; }), 20);
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const auto a = folder.write("a.ply", ply(first.vertices, first.faces, {.format = format, .extras = true}));
    const auto b = folder.write("b.ply", ply(second.vertices, {}, {.format = format, .real = "double"}));
    for (const std::string method : {"brute-force", "multi-level-sb-exact"})
      EXPECT_EQ(contacts({a, b, "--tolerance", "0.07", "--method", method}), expected) << format << ", " << method;
  }
}

TEST_F(DetectBodies, AreWhatTheOptionSays) {
  const std::string text = "v 0 0 0\nv 1 0 0\nv 2 0 0\no b\nv 3 0 0\nv 4 0 0\nv 5 0 0\nv 6 0 0\nf 1 2 4\nf 5 6 6\n";
  const std::string obj = folder.write("a.obj", text);
  const auto bodies = [&](const char* by) { return detect({obj, "--tolerance", "0.1", "--bodies", by})["bodies"]; };
  EXPECT_EQ(bodies("components"), 3) << "and faces may join objects";
  EXPECT_EQ(bodies("one"), 1);
  expect_refused({"detect", obj, "--tolerance", "1"}, {obj + ":9: ", "across bodies", "--bodies components"});
  const std::string file = folder.write("b.ply", ply({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {{0, 1, 3}}));
  EXPECT_EQ(detect({file, "--tolerance", "0.1"})["bodies"], 2);
  EXPECT_EQ(detect({file, "--tolerance", "0.1", "--bodies", "objects"})["bodies"], 1);
}

TEST_F(DetectBodies, MayComeThroughAPipe) {
  const State state = random_state(2);
  const Scattered file(state, 2);
  for (const std::string& text : {state.obj(), ply(file.vertices, file.faces, {.format = "binary_big_endian"})}) {
    const std::string path = folder.write("a", text), out = folder.path() / "out";
    const std::string command =
        "cat " + path + " | " SBCOLLIDE_PROGRAM " detect /dev/stdin --tolerance 0.07 --json > " + out;
    EXPECT_EQ(std::system(command.c_str()), 0);
    EXPECT_EQ(json::parse(read_file(out))["frames"][0]["contacts"], oracle(0, state, {.tolerance = 0.07f}).size());
  }
}

TEST_F(DetectBodies, ThatAreSingleFacesAreNoted) {
  std::vector<std::array<float, 3>> vertices;
  std::vector<std::vector<unsigned>> faces;
  for (unsigned f = 0; f < 3; ++f) {
    faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
    for (unsigned c = 0; c < 3; ++c) vertices.push_back({float(c), float(f), 0});
  }
  const std::string file = folder.write("a.ply", ply(vertices, faces));
  const json parts = detect({file, "--tolerance", "0.1"})["warnings"],
             one = detect({file, "--tolerance", "0.1", "--bodies", "one"})["warnings"];
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_NE(parts[0].get<std::string>().find("3 faces are 3 bodies"), std::string::npos) << parts;
  EXPECT_EQ(one, json::array());
}

TEST_F(DetectBodies, FarFromTheOriginAreNoted) {
  for (const auto& [x, noted] : {std::pair(1e4f, false), std::pair(1e6f, true)}) {
    const std::string file = folder.write("a.ply", ply({{x, 0, 0}, {x, 1, 0}, {x, 0, 1}}, {{0, 1, 2}}));
    const json warnings = detect({file, "--tolerance", "0.1"})["warnings"];
    ASSERT_EQ(warnings.size(), noted ? 1u : 0u) << warnings;
    if (noted) {
      EXPECT_NE(warnings[0].get<std::string>().find("move the bodies near the origin"), std::string::npos) << warnings;
    }
  }
}

class DetectAll : public testing::Test {
 protected:
  /// Drops what differs from run to run.
  static json without_times(json document) {
    for (json& frame : document["frames"]) frame.erase("ms");
    return document;
  }
  TemporaryFolder folder;
  const State first = random_state(8), second = moved(first, 0.05f, 9);
  const std::vector<std::string> base{folder.write("1.obj", first.obj()), folder.write("2.obj", second.obj()),
                                      "--tolerance", "0.07"};
};

TEST_F(DetectAll, GivesForEachMethodWhatItGivesAlone) {
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{}, {"--no-reuse", "--repeat", "2"}, {"--no-self", "--levels", "6"}}) {
    std::vector<std::string> arguments = base;
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto with = [&](const std::string& method) {
      std::vector<std::string> words = arguments;
      words.insert(words.end(), {"--method", method});
      return without_times(detect(words));
    };
    std::vector<std::string> words = arguments;
    words.insert(words.end(), {"--method", "all"});
    const json list = detect(words);
    ASSERT_EQ(list.size(), collide::method_table().size());
    for (std::size_t m = 0; m < list.size(); ++m) {
      const collide::Method& method = collide::method_table()[m];
      json alone = with(std::string(method.key)), one = without_times(list[m]);
      EXPECT_EQ(one["reference"], "brute-force");
      EXPECT_EQ(one["precision"], 1.0);
      EXPECT_TRUE(one["recall"] == 1.0 || !method.exact) << method.key;
      for (const char* key : {"reference", "recall", "precision"}) one.erase(key);
      for (json& frame : one["frames"])
        for (const char* key : {"recall", "precision"}) frame.erase(key);
      EXPECT_EQ(one, alone) << method.key;
    }
  }
}

TEST_F(DetectAll, CountsWhatTheLiteralMethodMisses) {
  std::vector<std::string> arguments = base;
  arguments.insert(arguments.end(), {"--cell-size", "0.02", "--buckets", "16000057", "--method", "all"});
  std::size_t expected = 0, found = 0;
  for (const auto& [state, frame] : {std::pair(&first, 0u), std::pair(&second, 1u)})
    expected += oracle(frame, *state, {.tolerance = 0.07f, .edges = &first}).size();
  for (const json& document : detect(arguments)) {
    if (document["method"] != collide::paper_method) continue;
    for (const json& frame : document["frames"]) found += frame["contacts"].get<std::size_t>();
    EXPECT_LT(found, expected);
    EXPECT_DOUBLE_EQ(document["recall"], double(found) / double(expected));
  }
  EXPECT_GT(found, 0u);
}

TEST_F(DetectAll, PrintsALineForEachMethod) {
  std::vector<std::string> arguments = base;
  arguments.insert(arguments.begin(), "detect");
  arguments.insert(arguments.end(), {"--method", "all"});
  const Outcome o = run(arguments);
  EXPECT_EQ(o.status, 0);
  EXPECT_EQ(o.err, "");
  EXPECT_EQ(std::ranges::count(o.out, '\n'), 3 + std::ptrdiff_t(collide::method_table().size())) << o.out;
  for (const collide::Method& method : collide::method_table())
    EXPECT_NE(o.out.find("\n" + std::string(method.key) + " "), std::string::npos) << o.out;
}

TEST_F(DetectAll, LeavesOutMethodsThatWouldTakeTooLong) {
  // Brute force, and others that test all pairs of a body, would need minutes.
  std::string text = "ply\nformat ascii 1.0\nelement vertex 350000\n";
  text += "property float x\nproperty float y\nproperty float z\nend_header\n";
  for (int i = 0; i < 350'000; ++i) text += std::to_string(i) + " 0 0\n";
  const std::string file = folder.write("a.ply", text);
  const std::vector<std::string> all{file,          "--tolerance", "1.5",      "--method", "all",
                                     "--cell-size", "2",           "--levels", "9"};
  const json list = detect(all);
  for (const json& document : list) {
    EXPECT_NE(document["reference"], "brute-force");
    if (document["method"] == "brute-force") {
      EXPECT_NE(document["not_run"].get<std::string>().find("61,249 million pair tests"), std::string::npos);
      EXPECT_TRUE(document["frames"].empty());
    }
    if (document["method"] == "multi-level-sb-exact") {
      EXPECT_EQ(document["frames"][0]["contacts"], 349'999);
    }
  }
  std::vector<std::string> words = all;
  words.insert(words.begin(), "detect");
  const Outcome table = run(words);
  EXPECT_NE(table.out.find("\nbrute-force                  not run"), std::string::npos) << table.out;
}

}  // namespace THIS_FILE
}  // namespace cli::test
