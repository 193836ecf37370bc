// Compares `detect --continuous` with a loop over all pairs of features, and checks the form of its output.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <random>
#include <sstream>

#include "collide/oracle/moving_features.h"
#include "tests/cli/ply_rig.h"
#include "tests/cli/process.h"

namespace cli::test {
namespace THIS_FILE {

using collide::oracle::Meeting;
using collide::oracle::MovingFeatures;
using collide::oracle::MovingPoint;
using nlohmann::json;

/// A line of the file of meetings; vertices that a line does not have are -1.
struct Row {
  bool edges;
  std::array<int, 5> vertices;  // a0, a1, b0, b1, b2
  double low, high;
  bool passes;
  auto operator<=>(const Row&) const = default;
};

std::vector<Row> read_rows(const std::filesystem::path& file) {
  std::istringstream text(read_file(file));
  std::string line;
  std::getline(text, line);
  EXPECT_EQ(line, "kind,a0,a1,b0,b1,b2,time_low,time_high,passes");
  std::vector<Row> rows;
  while (std::getline(text, line)) {
    std::vector<std::string> fields(1);
    for (const char c : line) c == ',' ? void(fields.emplace_back()) : fields.back().push_back(c);
    EXPECT_EQ(fields.size(), 9u) << line;
    Row& row = rows.emplace_back();
    row.edges = fields[0] == "ee";
    EXPECT_TRUE(row.edges || fields[0] == "vf") << line;
    for (std::size_t k = 0; k < 5; ++k) row.vertices[k] = fields[k + 1].empty() ? -1 : std::stoi(fields[k + 1]);
    EXPECT_EQ(fields[row.edges ? 5 : 2], "") << line;
    row.low = std::strtod(fields[6].c_str(), nullptr);
    row.high = std::strtod(fields[7].c_str(), nullptr);
    row.passes = fields[8] == "1";
    EXPECT_TRUE(row.passes || fields[8] == "0") << line;
  }
  return rows;
}

/// Two frames of a mesh; vertices count from 0.
struct Motion {
  std::vector<MovingPoint> points;
  std::vector<std::array<int, 3>> faces;
  std::vector<std::vector<int>> lines;

  std::string obj(glm::dvec3 MovingPoint::*time) const {
    std::string text;
    for (const MovingPoint& p : points)
      text += fmt::format("v {} {} {}\n", (p.*time).x, (p.*time).y, (p.*time).z);  // with all digits
    for (const auto& [a, b, c] : faces) text += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
    for (const auto& line : lines) {
      text += 'l';
      for (const int v : line) text += fmt::format(" {}", v + 1);
      text += '\n';
    }
    return text;
  }

  std::vector<std::array<int, 2>> edges() const {
    std::vector<std::array<int, 2>> list;
    const auto add = [&](int a, int b) {
      if (a != b) list.push_back({std::min(a, b), std::max(a, b)});
    };
    for (const auto& [a, b, c] : faces) add(a, b), add(b, c), add(a, c);
    for (const auto& line : lines)
      for (std::size_t k = 1; k < line.size(); ++k) add(line[k - 1], line[k]);
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
    return list;
  }

  std::vector<Row> meetings() const {
    std::vector<Row> rows;
    const auto at = [&](int v) -> const MovingPoint& { return points[static_cast<std::size_t>(v)]; };
    using Kind = MovingFeatures::Kind;
    const auto add = [&](const std::array<int, 5>& v, const MovingFeatures& features) {
      if (const std::optional<Meeting> meeting = meeting_of(features))
        rows.push_back(
            {features.kind == Kind::edge_edge, v, meeting->low, meeting->high, passage_of(features).has_value()});
    };
    for (int v = 0; v < static_cast<int>(points.size()); ++v)
      for (const auto& [a, b, c] : faces)
        if (v != a && v != b && v != c) add({v, -1, a, b, c}, {Kind::vertex_face, {at(v), at(a), at(b), at(c)}});
    const auto all = edges();
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t k = i + 1; k < all.size(); ++k) {
        const auto [a, b] = all[i];
        const auto [c, d] = all[k];
        if (a != c && a != d && b != c && b != d)
          add({a, b, c, d, -1}, {Kind::edge_edge, {at(a), at(b), at(c), at(d)}});
      }
    std::ranges::sort(rows);
    return rows;
  }

  /// Returns the number of the surface of each vertex: what faces and lines connect.
  std::vector<int> surfaces() const {
    std::vector<int> of(points.size());
    std::iota(of.begin(), of.end(), 0);
    const auto all = edges();
    for (bool changed = true; changed;) {
      changed = false;
      for (const auto& [a, b] : all) {
        int &one = of[static_cast<std::size_t>(a)], &other = of[static_cast<std::size_t>(b)];
        changed = changed || one != other;
        one = other = std::min(one, other);
      }
    }
    return of;
  }
};

/// Returns faces, lines and lone vertices, some of which coincide.
Motion random_motion(unsigned seed, bool whole_numbers) {
  std::mt19937_64 random(seed);
  const auto coordinate = [&] {
    return whole_numbers ? static_cast<double>(random() % 4) : std::uniform_real_distribution<double>(-1, 1)(random);
  };
  const auto position = [&] { return glm::dvec3(coordinate(), coordinate(), coordinate()); };
  Motion motion;
  constexpr int patches = 8;
  for (int patch = 0; patch < patches; ++patch) {
    const int first = 5 * patch;
    for (int v = 0; v < 5; ++v)
      motion.points.push_back(v == 4 ? motion.points[random() % motion.points.size()]
                                     : MovingPoint{position(), position()});
    motion.faces.push_back({first, first + 1, first + 2});
    motion.faces.push_back({first + 2, first + 1, first + 3});
    motion.faces.push_back({first, first + 3, first});
    if (patch % 2 == 0) motion.lines.push_back({first + 4, first, (first + 7) % (5 * patches), first + 1});
  }
  return motion;
}

class DetectContinuous : public testing::Test {
 protected:
  std::vector<std::string> files(const Motion& motion) {
    return {folder.write("from.obj", motion.obj(&MovingPoint::from)),
            folder.write("to.obj", motion.obj(&MovingPoint::to))};
  }
  /// Returns the meetings that the program lists.
  std::vector<Row> listed(std::vector<std::string> arguments) {
    const std::string csv = folder.path() / "meetings.csv";
    arguments.insert(arguments.end(), {"--continuous", "--contacts", csv});
    figures = detect(arguments);
    return read_rows(csv);
  }

  TemporaryFolder folder;
  json figures;  // what the last listed() printed
};

TEST_F(DetectContinuous, ListsWhatALoopOverAllPairsFinds) {
  for (const bool whole_numbers : {false, true}) {
    const Motion motion = random_motion(7, whole_numbers);
    const std::vector<Row> expected = motion.meetings();
    EXPECT_GT(expected.size(), 100u);
    for (const char* threads : {"1", "2", "5"}) {
      std::vector<std::string> arguments = files(motion);
      arguments.insert(arguments.end(), {"--threads", threads});
      EXPECT_EQ(listed(arguments), expected) << "threads " << threads;
    }
    const std::vector<int> surfaces = motion.surfaces();
    const auto count = [&](bool edges, bool passages, bool own) {
      return std::ranges::count_if(expected, [&](const Row& r) {
        const auto surface = [&](std::size_t k) { return surfaces[static_cast<std::size_t>(r.vertices[k])]; };
        return r.edges == edges && (r.passes || !passages) && (surface(0) == surface(2)) == own;
      });
    };
    for (const bool edges : {false, true})
      for (const bool passages : {false, true})
        for (const bool own : {false, true})
          EXPECT_EQ(figures[passages ? "passages" : "meetings"][edges ? "ee" : "vf"][own ? "own" : "others"],
                    count(edges, passages, own));
    EXPECT_EQ(figures["vertices"], motion.points.size());
    EXPECT_EQ(figures["faces"], motion.faces.size());
    EXPECT_EQ(figures["edges"], motion.edges().size());
    EXPECT_EQ(figures["surfaces"], std::set<int>(surfaces.begin(), surfaces.end()).size());
  }
}

/// A vertex that ends above a face by less than floats can tell.
Motion near_miss() {
  return {{{{0, 0, 0}, {0, 0, 0}},
           {{4, 0, 0}, {4, 0, 0}},
           {{0, 4, 0}, {0, 4, 0}},
           {{1, 1, 1}, {1, 1, 0x1p-1000}},
           {{1, 1 + 0x1p-40, 1}, {1, 1, 0}}},
          {{0, 1, 2}},
          {}};
}

TEST_F(DetectContinuous, ReadsNumbersAsDoubles) {
  const std::vector<Row> expected{{false, {4, -1, 0, 1, 2}, 1, 1, false}};
  EXPECT_EQ(listed(files(near_miss())), expected);
  Motion far = near_miss();
  for (MovingPoint& p : far.points) p.from *= 1e300, p.to *= 1e300;
  EXPECT_EQ(listed(files(far)), expected);
}

TEST_F(DetectContinuous, CutsPolygonsAsTheyLieInTheFirstFrame) {
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
  const std::string from = folder.write("from.obj", square + "v 0.75 0.5 1\nv 0.25 0.5 1\n"),
                    to = folder.write("to.obj", square + "v 0.75 0.5 -1\nv 0.25 0.5 -1\n");
  const std::vector<Row> rows = listed({from, to});
  ASSERT_EQ(rows.size(), 2u);
  for (const Row& row : rows) EXPECT_TRUE(row.low == 0.5 && row.high == 0.5 && row.passes);
  EXPECT_EQ(figures["faces"], 2);
  EXPECT_EQ(figures["edges"], 5);
  EXPECT_EQ(figures["surfaces"], 3);
}

TEST_F(DetectContinuous, ReadsPlyFiles) {
  const std::vector<std::array<float, 3>> from{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 1}};
  std::vector<std::array<float, 3>> to = from;
  to[3] = {1, 1, -3};
  for (const PlyForm& form : ply_forms()) {
    const std::string first = folder.write("from.ply", ply(from, {{0, 1, 2}}, form)),
                      last = folder.write("to.ply", ply(to, {{0, 1, 2}}, form));
    EXPECT_EQ(listed({first, last}), (std::vector<Row>{{false, {3, -1, 0, 1, 2}, 0.25, 0.25, true}})) << text_of(form);
  }
}

TEST_F(DetectContinuous, PrintsATable) {
  std::vector<std::string> arguments = files(near_miss());
  arguments.insert(arguments.begin(), "detect");
  arguments.push_back("--continuous");
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* word : {"surfaces 3", "vertices 5", "vertex and face", "edge and edge"})
    EXPECT_NE(outcome.out.find(word), std::string::npos) << outcome.out;
}

TEST_F(DetectContinuous, RefusesWhatDoesNotFit) {
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  const std::string good = folder.write("good.obj", three + "f 1 2 3\nl 1 4\n");
  const auto refuse = [&](const std::string& text, const std::vector<std::string>& words) {
    const std::string other = folder.write("other.obj", text);
    expect_refused({"detect", good, other, "--continuous"}, words);
  };
  refuse(three + "v 1 1 1\nf 1 2 3\nl 1 4\n", {"other.obj", "good.obj", "number of vertices 5", "4"});
  refuse(three + "l 1 4\n", {"number of faces 0"});
  refuse(three + "f 1 2 3\n", {"number of segments of lines 0"});
  refuse(three + "f 1 2 4\nl 1 4\n", {"other.obj:5: another face than ", "good.obj:5"});
  refuse(three + "f 1 2 3 4\nl 1 4\n", {"other.obj:5: another face than "});
  refuse(three + "f 1 2 3\nl 4 1\n", {"other.obj:6: another line than "});
  refuse(three + "f 1 2 3\nl 1 5\n", {"other.obj:6: a line names vertex 5 of 4"});
  refuse(three + "f 1 2 3\nl\n", {"other.obj:6: a line without a vertex"});
  refuse("v 0 0 1e309\n", {"other.obj:1: '1e309'", "as a double"});
  expect_refused({"detect", good, "--continuous"}, {"--continuous", "two files"});
  expect_refused({"detect", good, good, good, "--continuous"}, {"--continuous", "two files"});
  for (const std::vector<std::string>& more : {std::vector<std::string>{"--tolerance", "1"},
                                               {"--method", "all"},
                                               {"--bodies", "one"},
                                               {"--rest", good},
                                               {"--repeat", "2"},
                                               {"--no-self"},
                                               {"--no-reuse"}}) {
    std::vector<std::string> arguments{"detect", good, good, "--continuous"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_refused(arguments, {"--continuous", more[0] == "--no-self" ? "--self" : more[0]});
  }
  expect_refused({"detect", good, good, "--continuous", "--contacts", good}, {"is the input"});
}

}  // namespace THIS_FILE
}  // namespace cli::test
