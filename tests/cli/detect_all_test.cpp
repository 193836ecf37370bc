// `detect` with what a body is left to the user, and with all methods side by side.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "collide/methods.h"
#include "tests/cli/detect_rig.h"
#include "tests/cli/ply_rig.h"

namespace cli::test {
namespace THIS_FILE {

using nlohmann::json;

using DetectBodies = DetectFolder;

/// Two bodies whose vertices take turns in the file.
const std::vector<std::array<float, 3>> scattered{{0, 0, 0}, {5, 0.0625, 0}, {5, 0, 0},
                                                  {9, 9, 0}, {0, 5, 0},      {0, 0.03125, 0}};
const std::vector<std::vector<unsigned>> faces{{0, 2, 4}, {1, 3, 5}};

TEST_F(DetectBodies, NamesVerticesAsTheFileDoes) {
  std::vector<std::array<float, 3>> next = scattered;
  next[3] = {0, 5, 0.0625};
  const std::vector<ContactRow> expected{{0, 0, 5, 0, 1, 0.03125},
                                         {0, 1, 2, 1, 0, 0.0625},
                                         {1, 0, 5, 0, 1, 0.03125},
                                         {1, 1, 2, 1, 0, 0.0625},
                                         {1, 3, 4, 1, 0, 0.0625}};
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const auto a = folder.write("a.ply", ply(scattered, faces, {.format = format, .extras = true}));
    const auto b = folder.write("b.ply", ply(next, {}, {.format = format, .real = "double"}));
    for (const std::string method : {"brute-force", "multi-level-sb-exact"})
      EXPECT_EQ(contacts({a, b, "--tolerance", "0.07", "--method", method}), expected) << format << ", " << method;
  }
}

TEST_F(DetectBodies, TakesObjectsComponentsOrAllAsTheOptionSays) {
  const std::string text = "v 0 0 0\nv 1 0 0\nv 2 0 0\no b\nv 3 0 0\nv 4 0 0\nv 5 0 0\nv 6 0 0\nf 1 2 4\nf 5 6 6\n";
  const std::string obj = folder.write("a.obj", text),
                    ply_file = folder.write("b.ply", ply({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {{0, 1, 3}}));
  const auto bodies = [](const std::string& mesh, const Words& by) {
    return detect(with({mesh, "--tolerance", "0.1"}, by))["bodies"];
  };
  EXPECT_EQ(bodies(obj, {"--bodies", "components"}), 3) << "and faces may join objects";
  EXPECT_EQ(bodies(obj, {"--bodies", "one"}), 1);
  expect_refused({"detect", obj, "--tolerance", "1"}, {obj + ":9: ", "across bodies", "--bodies components"});
  EXPECT_EQ(bodies(ply_file, {}), 2);
  EXPECT_EQ(bodies(ply_file, {"--bodies", "objects"}), 1);
}

TEST_F(DetectBodies, ReadsThemThroughAPipe) {
  for (const auto& [text, contacts] :
       {std::pair(random_state(2).obj(), oracle(0, random_state(2), {.tolerance = 0.07f}).size()),
        std::pair(ply(scattered, faces, {.format = "binary_big_endian"}), std::size_t{2})}) {
    const std::string path = folder.write("a", text), out = folder.path() / "out";
    const std::string command =
        "cat " + path + " | " SBCOLLIDE_PROGRAM " detect /dev/stdin --tolerance 0.07 --json > " + out;
    EXPECT_EQ(std::system(command.c_str()), 0);
    EXPECT_EQ(json::parse(read_file(out))["frames"][0]["contacts"], contacts);
  }
}

TEST_F(DetectBodies, NotesSingleFacesAndPositionsFarFromTheOrigin) {
  std::vector<std::array<float, 3>> vertices;
  for (unsigned v = 0; v < 9; ++v) vertices.push_back({float(v % 3), float(v / 3), 0});
  const std::string single = ply(vertices, {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}});
  const auto far = [](float x) { return ply({{x, 0, 0}, {x, 1, 0}, {x, 0, 1}}, {{0, 1, 2}}); };
  struct Noted {
    std::string file;
    Words options;
    const char* note;  // nullptr: none
  };
  for (const auto& [text, options, note] :
       {Noted{single, {}, "3 faces are 3 bodies"}, Noted{single, {"--bodies", "one"}, nullptr},
        Noted{far(1e4f), {}, nullptr}, Noted{far(1e6f), {}, "move the bodies near the origin"}}) {
    const json warnings = detect(with({folder.write("a.ply", text), "--tolerance", "0.1"}, options))["warnings"];
    ASSERT_EQ(warnings.size(), note ? 1u : 0u) << warnings;
    EXPECT_TRUE(!note || warnings[0].get<std::string>().find(note) != std::string::npos) << warnings;
  }
}

class DetectAll : public DetectFolder {
 protected:
  /// Drops what differs from run to run.
  static json without_times(json document) {
    for (json& frame : document["frames"]) frame.erase("ms");
    return document;
  }
  const State first = random_state(8), second = moved(first, 0.05f, 9);
  const Words frames{file("1.obj", first), file("2.obj", second), "--tolerance", "0.07"};
};

TEST_F(DetectAll, GivesForEachMethodWhatItGivesAlone) {
  for (const Words& more : {Words{}, {"--no-reuse", "--repeat", "2"}, {"--no-self", "--levels", "6"}}) {
    const json list = detect(with(with(frames, more), {"--method", "all"}));
    ASSERT_EQ(list.size(), collide::method_table().size());
    for (std::size_t m = 0; m < list.size(); ++m) {
      const collide::Method& method = collide::method_table()[m];
      const json alone = without_times(detect(with(with(frames, more), {"--method", std::string(method.key)})));
      json one = without_times(list[m]);
      EXPECT_EQ(one["reference"], "brute-force");
      EXPECT_EQ(one["precision"], 1.0);
      EXPECT_TRUE(one["recall"] == 1.0 || !method.exact) << method.key;
      EXPECT_TRUE(one["first_false"].is_null() && one["first_missed"].is_null() == (one["recall"] == 1.0)) << one;
      for (const char* key : {"reference", "recall", "precision", "first_missed", "first_false"}) one.erase(key);
      for (json& frame : one["frames"])
        for (const char* key : {"recall", "precision", "first_missed", "first_false"}) frame.erase(key);
      EXPECT_EQ(one, alone) << method.key;
    }
  }
}

/// Returns the first of the rows that are missing in another list; null if there is none.
json first_missing(const std::vector<ContactRow>& rows, const std::vector<ContactRow>& in) {
  for (const ContactRow& r : rows)
    if (!std::ranges::binary_search(in, r))
      return {{"frame", r.frame},   {"vertex_a", r.vertex_a}, {"vertex_b", r.vertex_b},
              {"body_a", r.body_a}, {"body_b", r.body_b},     {"distance", double{r.distance}}};
  return nullptr;
}

TEST_F(DetectAll, CountsWhatTheLiteralMethodMissesAndNamesTheFirst) {
  const Words settings = with(frames, {"--cell-size", "0.02", "--buckets", "16000057", "--method"});
  std::vector<std::vector<ContactRow>> truth;  // by frame
  for (const auto& [state, frame] : {std::pair(&first, 0u), std::pair(&second, 1u)})
    truth.push_back(oracle(frame, *state, {.tolerance = 0.07f, .edges = &first}));
  const std::vector<ContactRow> found = contacts(with(settings, {std::string(collide::paper_method)}));
  for (const json& document : detect(with(settings, {"all"}))) {
    if (document["method"] != collide::paper_method) continue;
    const std::size_t expected = truth[0].size() + truth[1].size();
    EXPECT_LT(found.size(), expected);
    EXPECT_DOUBLE_EQ(document["recall"], double(found.size()) / double(expected));
    EXPECT_FALSE(document["first_missed"].is_null());
    EXPECT_EQ(document["first_missed"], document["frames"][0]["first_missed"]);
    for (std::size_t frame = 0; frame < truth.size(); ++frame)
      EXPECT_EQ(document["frames"][frame]["first_missed"], first_missing(truth[frame], found));
    const json& pair = document["first_missed"];
    const std::string line =
        "  first missed: vertices " + pair["vertex_a"].dump() + " and " + pair["vertex_b"].dump() + " in frame 0, ";
    EXPECT_NE(run(with({"detect"}, with(settings, {"all"}))).out.find(line), std::string::npos) << line;
  }
  EXPECT_GT(found.size(), 0u);
}

TEST_F(DetectAll, PrintsALineForEachMethod) {
  const Outcome o = run(with({"detect", "--method", "all"}, frames));
  EXPECT_EQ(o.status, 0);
  EXPECT_EQ(o.err, "");
  const bool misses = o.out.find("\n  first missed: ") != std::string::npos;
  EXPECT_EQ(std::ranges::count(o.out, '\n'), 3 + std::ptrdiff_t(collide::method_table().size()) + misses) << o.out;
  for (const collide::Method& method : collide::method_table())
    EXPECT_NE(o.out.find("\n" + std::string(method.key) + " "), std::string::npos) << o.out;
}

TEST_F(DetectAll, LeavesOutMethodsThatWouldTakeTooLong) {
  // Brute force, and others that test all pairs of a body, would need minutes.
  std::string text = "ply\nformat ascii 1.0\nelement vertex 350000\n";
  text += "property float x\nproperty float y\nproperty float z\nend_header\n";
  for (int i = 0; i < 350'000; ++i) text += std::to_string(i) + " 0 0\n";
  const Words all = with({folder.write("a.ply", text), "--method", "all", "--tolerance", "1.5"},
                         {"--cell-size", "2", "--levels", "15", "--buckets", "1000003"});
  for (const json& document : detect(all)) {
    EXPECT_NE(document["reference"], "brute-force");
    if (document["method"] == "brute-force") {
      EXPECT_NE(document["not_run"].get<std::string>().find("61,249 million pair tests"), std::string::npos);
      EXPECT_TRUE(document["frames"].empty());
    }
    if (document["method"] == "multi-level-sb-exact") {
      EXPECT_EQ(document["frames"][0]["contacts"], 349'999);
    }
  }
  const Outcome table = run(with({"detect"}, all));
  EXPECT_NE(table.out.find("\nbrute-force                  not run"), std::string::npos) << table.out;
}

}  // namespace THIS_FILE
}  // namespace cli::test
