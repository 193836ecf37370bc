// `detect --continuous`: which features of two files it searches, and the form of its output. What meets is known by
// construction here; tests/collide compares the search with a loop over all pairs.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/cli/ply_rig.h"
#include "tests/cli/process.h"

namespace cli::test {
namespace THIS_FILE {

using nlohmann::json;

constexpr const char* heading = "kind,a0,a1,b0,b1,b2,time_low,time_high,passes\n";
const std::string triangle = "v 0 0 0\nv 4 0 0\nv 0 4 0\n";

class DetectContinuous : public testing::Test {
 protected:
  Words files(const std::string& from, const std::string& to, const std::string& ending = ".obj") const {
    return {folder.write("from" + ending, from), folder.write("to" + ending, to)};
  }
  /// Returns the lines of the file of meetings, below its heading.
  std::string listed(const Words& arguments) {
    const std::string csv = folder.path() / "meetings.csv";
    figures = detect(with(arguments, {"--continuous", "--contacts", csv}));
    const std::string text = read_file(csv);
    EXPECT_TRUE(text.starts_with(heading)) << text;
    return text.substr(std::string(heading).size());
  }

  TemporaryFolder folder;
  json figures;  // what the last listed() printed
};

/// A face that stands twice in the file, and two lines; one of them begins at the face. Vertices 3 and 6 fall through
/// the face, vertex 7 ends on it, and the edge of 5 and 6 falls through the one of 0 and 1.
TEST_F(DetectContinuous, ListsMeetingsOfVerticesWithFacesAndOfEdges) {
  const std::string features = "f 1 2 3\nf 1 2 3\nl 4 5 1\nl 6 7\n";
  const Words both = files(triangle + "v 1 1 1\nv 1 1 3\nv 2 -1 1\nv 2 1 1\nv 1 2 1\n" + features,
                           triangle + "v 1 1 -3\nv 1 1 1\nv 2 -1 -1\nv 2 1 -1\nv 1 2 0\n" + features);
  for (const char* threads : {"1", "2", "5"}) {
    EXPECT_EQ(listed(with(both, {"--threads", threads})),
              "vf,3,,0,1,2,0.25,0.25,1\nvf,6,,0,1,2,0.5,0.5,1\nvf,7,,0,1,2,1,1,0\nee,0,1,5,6,,0.5,0.5,1\n");
    figures.erase("ms");
    const auto counts = [](int own, int others) { return json{{"own", own}, {"others", others}}; };
    EXPECT_EQ(figures, (json{{"threads", std::stoi(threads)},
                             {"surfaces", 3},
                             {"vertices", 8},
                             {"edges", 6},
                             {"faces", 1},
                             {"meetings", {{"vf", counts(1, 2)}, {"ee", counts(0, 1)}}},
                             {"passages", {{"vf", counts(1, 1)}, {"ee", counts(0, 1)}}}}));
  }
  const Outcome table = run(with({"detect", "--continuous"}, both));
  EXPECT_EQ(table.status, 0) << table.err;
  for (const char* text : {"surfaces 3, vertices 8, edges 6, faces 1, ",
                           "vertex and face             1            2            1            1\n",
                           "edge and edge               0            1            0            1\n"})
    EXPECT_NE(table.out.find(text), std::string::npos) << table.out;
}

/// One vertex ends above the face by less than floats can tell, the other on it.
TEST_F(DetectContinuous, ReadsNumbersAsDoubles) {
  const Words both = files(triangle + "v 1 1 1\nv 1 1.0000000000009094947017729282379150390625 1\nf 1 2 3\n",
                           triangle + "v 1 1 9.33263618503219e-302\nv 1 1 0\nf 1 2 3\n");
  EXPECT_EQ(listed(both), "vf,4,,0,1,2,1,1,0\n");
}

TEST_F(DetectContinuous, CutsPolygonsAsTheyLieInTheFirstFrame) {
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
  const std::string found =
      listed(files(square + "v 0.75 0.5 1\nv 0.25 0.5 1\n", square + "v 0.75 0.5 -1\nv 0.25 0.5 -1\n"));
  EXPECT_EQ(std::count(found.begin(), found.end(), '\n'), 2) << "neither meets the diagonal: " << found;
  EXPECT_NE(found.find(",0.5,0.5,1\n"), std::string::npos) << found;
  EXPECT_EQ(figures["faces"], 2);
  EXPECT_EQ(figures["edges"], 5);
}

TEST_F(DetectContinuous, ReadsPlyFiles) {
  const std::vector<std::array<float, 3>> from{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 1}};
  std::vector<std::array<float, 3>> to = from;
  to[3] = {1, 1, -3};
  for (const PlyForm& form : ply_forms())
    EXPECT_EQ(listed(files(ply(from, {{0, 1, 2}}, form), ply(to, {{0, 1, 2}}, form), ".ply")),
              "vf,3,,0,1,2,0.25,0.25,1\n")
        << text_of(form);
}

TEST_F(DetectContinuous, RefusesWhatDoesNotFit) {
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  const std::string good = folder.write("good.obj", three + "f 1 2 3\nl 1 4\n");
  for (const auto& [text, words] : std::vector<std::pair<std::string, Words>>{
           {three + "v 1 1 1\nf 1 2 3\nl 1 4\n", {"other.obj", "good.obj", "number of vertices 5", "4"}},
           {three + "l 1 4\n", {"number of faces 0"}},
           {three + "f 1 2 3\n", {"number of segments of lines 0"}},
           {three + "f 1 2 4\nl 1 4\n", {"other.obj:5: another face than ", "good.obj:5"}},
           {three + "f 1 2 3 4\nl 1 4\n", {"other.obj:5: another face than "}},
           {three + "f 1 2 3\nl 4 1\n", {"other.obj:6: another line than "}},
           {three + "f 1 2 3\nl 1 5\n", {"other.obj:6: a line names vertex 5 of 4"}},
           {three + "f 1 2 3\nl\n", {"other.obj:6: a line without a vertex"}},
           {"v 0 0 1e309\n", {"other.obj:1: '1e309'", "as a double"}}})
    expect_refused({"detect", good, folder.write("other.obj", text), "--continuous"}, words);
  expect_refused({"detect", good, "--continuous"}, {"--continuous", "two files"});
  expect_refused({"detect", good, good, good, "--continuous"}, {"--continuous", "two files"});
  for (const Words& more : {Words{"--tolerance", "1"},
                            {"--method", "all"},
                            {"--bodies", "one"},
                            {"--rest", good},
                            {"--repeat", "2"},
                            {"--no-self"},
                            {"--no-reuse"}})
    expect_refused(with({"detect", good, good, "--continuous"}, more),
                   {"--continuous", more[0] == "--no-self" ? "--self" : more[0]});
  expect_refused({"detect", good, good, "--continuous", "--contacts", good}, {"is the input"});
}

}  // namespace THIS_FILE
}  // namespace cli::test
