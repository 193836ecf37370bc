// The search for features that meet, against a loop over all pairs.

#include "collide/oracle/moving_mesh.h"

#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

#include "ccd_queries.h"

namespace collide::test {

using namespace collide::oracle;

namespace THIS_FILE {

using Kind = MovingPair::Kind;
using Random = std::mt19937_64;

Query query_of(const MovingMesh& mesh, const MovingPair& pair) {
  const auto& p = mesh.points;
  const auto& [kind, a, b] = pair;
  if (kind == Kind::vertex_face) return {Query::Kind::vertex_face, {p[a[0]], p[b[0]], p[b[1]], p[b[2]]}};
  return {Query::Kind::edge_edge, {p[a[0]], p[a[1]], p[b[0]], p[b[1]]}};
}

/// Returns all pairs of features without a common vertex.
std::vector<MovingPair> all_pairs(const MovingMesh& mesh) {
  std::vector<MovingPair> pairs;
  for (const auto& [v] : mesh.vertices) {
    for (const surface::Triangle& face : mesh.faces) {
      if (v != face[0] && v != face[1] && v != face[2]) pairs.push_back({Kind::vertex_face, {v, v}, face});
    }
  }
  for (std::size_t i = 0; i < mesh.edges.size(); ++i) {
    for (std::size_t k = i + 1; k < mesh.edges.size(); ++k) {
      const auto& [a, b] = mesh.edges[i];
      const auto& [c, d] = mesh.edges[k];
      if (a != c && a != d && b != c && b != d) pairs.push_back({Kind::edge_edge, {a, b}, {c, d, d}});
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<FeatureMeeting> meetings_of(const MovingMesh& mesh, int threads) {
  std::vector<FeatureMeeting> meetings;
  Workers workers(threads, 0);
  find_meetings(mesh, workers, [&](const std::vector<FeatureMeeting>& found) {
    meetings.insert(meetings.end(), found.begin(), found.end());
  });
  return meetings;
}

/// Returns a mesh of random faces, some of which name a vertex twice, and of edges without a face. A fifth of all
/// vertices coincide with others.
MovingMesh random_mesh(Random& random, Index vertices, std::size_t faces, const std::function<double()>& coordinate) {
  MovingMesh mesh;
  const auto any = [&] { return static_cast<Index>(random() % vertices); };
  const auto position = [&] { return glm::dvec3(coordinate(), coordinate(), coordinate()); };
  for (Index v = 0; v < vertices; ++v) {
    mesh.vertices.push_back({v});
    const bool coincides = v > 0 && random() % 5 == 0;
    mesh.body.push_back(static_cast<Index>(random() % 4));
    mesh.points.push_back(coincides ? mesh.points[random() % v] : MovingPoint{position(), position()});
  }
  const auto add_edge = [&](Index a, Index b) {
    if (a != b) mesh.edges.push_back({std::min(a, b), std::max(a, b)});
  };
  for (std::size_t f = 0; f < faces; ++f) {
    const auto& [a, b, c] = mesh.faces.emplace_back(surface::Triangle{any(), any(), any()});
    add_edge(a, b);
    add_edge(b, c);
    add_edge(c, a);
    if (f % 4 == 0) add_edge(any(), any());
  }
  std::sort(mesh.edges.begin(), mesh.edges.end());
  mesh.edges.erase(std::unique(mesh.edges.begin(), mesh.edges.end()), mesh.edges.end());
  return mesh;
}

void expect_equal(const std::vector<FeatureMeeting>& found, const MovingMesh& mesh) {
  std::size_t next = 0;
  for (const MovingPair& pair : all_pairs(mesh)) {
    const std::optional<Meeting> meeting = meeting_of(query_of(mesh, pair));
    if (!meeting) continue;
    ASSERT_LT(next, found.size());
    const FeatureMeeting& f = found[next++];
    ASSERT_EQ(static_cast<const MovingPair&>(f), pair);
    ASSERT_EQ(f.first.low, meeting->low);
    ASSERT_EQ(f.first.high, meeting->high);
    ASSERT_EQ(f.passes, passage_of(query_of(mesh, pair)).has_value());
  }
  EXPECT_EQ(next, found.size());
}

TEST(FindMeetings, FindsWhatALoopOverAllPairsFinds) {
  Random random(52);
  const auto real = [&] { return std::uniform_real_distribution<double>(-1, 1)(random); };
  const auto whole = [&] { return static_cast<double>(random() % 4); };
  const auto float_real = [&] { return static_cast<double>(static_cast<float>(real())); };
  const auto any_magnitude = [&] { return std::ldexp(real(), static_cast<int>(random() % 200) - 100); };
  for (const std::function<double()>& coordinate :
       {std::function<double()>(real), std::function<double()>(whole), std::function<double()>(float_real),
        std::function<double()>(any_magnitude)}) {
    const MovingMesh mesh = random_mesh(random, 60, 25, coordinate);
    const std::vector<FeatureMeeting> found = meetings_of(mesh, 1);
    EXPECT_GT(found.size(), 20u);
    expect_equal(found, mesh);
    expect_equal(meetings_of(mesh, 3), mesh);
  }
}

TEST(FindMeetings, GivesThemInOrderPartByPart) {
  const Index count = 40'000;
  MovingMesh mesh;
  for (const glm::dvec3& corner : {glm::dvec3(-9, 0, -9), glm::dvec3(9, 0, -9), glm::dvec3(0, 0, 9)})
    mesh.points.push_back({corner, corner});
  mesh.faces.push_back({0, 1, 2});
  for (Index v = 3; v < count; ++v) {  // lone vertices that fall through the face
    const double x = std::sin(1.0 * v), z = std::cos(1.0 * v);
    mesh.points.push_back({{x, 1, z}, {x, -1, z}});
  }
  for (Index v = 0; v < count; ++v) mesh.vertices.push_back({v});
  mesh.body.resize(count);
  std::size_t parts = 0;
  Index next = 3;
  Workers workers(2, 0);
  find_meetings(mesh, workers, [&](const std::vector<FeatureMeeting>& found) {
    ++parts;
    for (const FeatureMeeting& meeting : found) ASSERT_EQ(meeting.feature[0], next++);
  });
  EXPECT_EQ(next, count);
  EXPECT_GT(parts, 1u);
}

}  // namespace THIS_FILE
}  // namespace collide::test
