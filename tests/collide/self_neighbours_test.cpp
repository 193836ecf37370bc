// The pairs of near features that are kept of a body while it moves, turns and bends.

#include "collide/surface/self_neighbours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "every_target.h"
#include "surface_meshes.h"

namespace collide::test {

using namespace collide::surface;
namespace THIS_FILE {

constexpr float margin = 0.02f;  // m

/// A body whose vertices are moved by hand.
struct Body {
  SurfaceMesh mesh;
  Surface surface;
  std::vector<float> ways;
  SelfNeighbours neighbours;
  SelfNeighbours::Scratch scratch;

  explicit Body(const SurfaceMesh& m)
      : mesh(m), surface(static_cast<Index>(m.vertices.size()), m.triangles), ways(m.vertices.size(), 0.0f) {}

  void cover(float near) {
    const Points3 at(mesh.vertices);
    neighbours.cover(surface, at.run(), near, ways, margin, scratch);
  }
  std::vector<ItemPair> pairs(bool of_edges) {
    scratch.found.clear();
    of_edges ? neighbours.add_edges(BoxPairs::unlimited, scratch)
             : neighbours.add_vertex_faces(BoxPairs::unlimited, scratch);
    std::ranges::sort(scratch.found);
    return std::move(scratch.found);
  }
  float way(std::initializer_list<Index> corners) const {
    float most = 0;
    for (const Index v : corners) most = std::max(most, ways[v]);
    return most;
  }
};

/// Expects all pairs that may come within `near` to be found, by plain loops. Returns how many there are.
std::size_t expect_complete(Body& body, float near) {
  const auto& at = body.mesh.vertices;
  const auto& faces = body.surface.triangles();
  const auto& edges = body.surface.edges();
  std::size_t expected = 0, missing = 0;
  const std::vector<ItemPair> vertex_faces = body.pairs(false), edge_edges = body.pairs(true);
  const auto expect = [&](const std::vector<ItemPair>& list, const ItemPair& pair) {
    ++expected;
    missing += !std::ranges::binary_search(list, pair);
  };
  for (Index v = 0; v < at.size(); ++v)
    for (Index f = 0; f < faces.size(); ++f) {
      const auto& [a, b, c] = faces[f];
      if (v == a || v == b || v == c) continue;
      const float distance = glm::length(closest_vertex_face(at[v], at[a], at[b], at[c]).separation);
      if (distance <= near + body.way({v}) + body.way({a, b, c})) expect(vertex_faces, {v, f});
    }
  for (Index i = 0; i < edges.size(); ++i)
    for (Index j = i + 1; j < edges.size(); ++j) {
      const auto& [a, b] = edges[i];
      const auto& [c, d] = edges[j];
      if (a == c || a == d || b == c || b == d) continue;
      const float distance = glm::length(closest_edges(at[a], at[b], at[c], at[d]).separation);
      if (distance <= near + body.way({a, b}) + body.way({c, d})) expect(edge_edges, {i, j});
    }
  EXPECT_EQ(missing, 0u);
  for (const auto& list : {vertex_faces, edge_edges}) EXPECT_EQ(std::ranges::adjacent_find(list), list.end());
  return expected;
}

TEST(SelfNeighbours, MissesNoPairWhileTheBodyBendsAndTurns) {
  std::mt19937 random(80);
  std::size_t pairs = 0, held = 0, searched = 0, all = 0;
  for (const SurfaceMesh& mesh : {ball(0.5f), sheet(10, 1), valley()}) {
    Body body(mesh);
    const std::vector<glm::vec3> r = random_points(random, 4, -1, 1);
    for (int step = 0; step < 40; ++step) {
      const float bend = 0.01f * uniform(random, 0, 1) * uniform(random, 0, 1), near = uniform(random, 0.1f, 0.13f);
      body.mesh = moved(turned(body.mesh, r[0], 0.1f), 0.3f * r[1]);
      const glm::vec3 place = body.mesh.vertices[random() % body.mesh.vertices.size()];
      for (glm::vec3& v : body.mesh.vertices)  // fold it up around a place, and shake it
        v += bend * ((place - v) / (0.2f + glm::length(place - v)) + 0.2f * random_points(random, 1, -1, 1)[0]);
      for (float& way : body.ways) way = uniform(random, 0, 0.01f);
      body.cover(near);
      pairs += expect_complete(body, near);
      held += body.neighbours.searched() == 0;
      searched += body.neighbours.searched();
      all += body.surface.vertex_count();
    }
  }
  EXPECT_GT(pairs, 10'000u);
  EXPECT_GT(held, 10u);
  EXPECT_LT(searched, all / 2);
}

/// Positions are rounded about the centre, and the distances of slivers are bounds: neither may lose a pair.
TEST(SelfNeighbours, FindsPairsThatAreExactlyAsFarApartAsAskedFor) {
  std::mt19937 random(81);
  for (const float squash : {1.0f, 1e-3f})
    for (int trial = 0; trial < 300; ++trial) {
      SurfaceMesh mesh = sheet(5, 1);
      for (glm::vec3& v : mesh.vertices) v.z *= squash;
      const std::vector<glm::vec3> r = random_points(random, 2, -1, 1);
      Body body(moved(turned(mesh, r[0], uniform(random, 0, 6)), r[1]));
      const std::vector<glm::vec3>& at = body.mesh.vertices;
      const auto& [a, b, c] = mesh.triangles[random() % mesh.triangles.size()];
      const glm::vec3& vertex = at[random() % at.size()];
      const float distance = glm::length(closest_vertex_face(vertex, at[a], at[b], at[c]).separation);
      body.cover(distance);
      expect_complete(body, distance);
    }
}

TEST(SelfNeighbours, KeepTheirPairsHoweverFarTheBodyFallsAndTurns) {
  Body body(valley());
  body.cover(0.05f);
  EXPECT_EQ(body.neighbours.searched(), body.surface.vertex_count());
  body.pairs(false), body.pairs(true);
  for (int step = 0; step < 200; ++step) {
    body.mesh = moved(turned(body.mesh, {1, 2, -1}, 0.2f), {0.1f, -0.5f, 0});
    body.cover(0.05f);
    EXPECT_EQ(body.neighbours.searched(), 0u) << step;
  }
}

TEST(SelfNeighbours, AreSearchedOnlyForVerticesThatHaveStrayed) {
  Body body(sheet(20, 2));
  body.cover(0.02f);
  body.pairs(false), body.pairs(true);
  std::vector<glm::vec3>& at = body.mesh.vertices;
  const glm::vec3 place = at[100];
  for (glm::vec3& v : at)
    if (glm::length(v - place) < 0.3f) v.y += 0.05f;
  body.cover(0.02f);
  EXPECT_GT(body.neighbours.searched(), 5u);
  EXPECT_LT(body.neighbours.searched(), 120u) << "of 441";
  expect_complete(body, 0.02f);
  body.cover(0.02f);
  EXPECT_EQ(body.neighbours.searched(), 0u);
}

TEST(SelfNeighbours, AreSearchedAnewForAnotherSurfaceAndAfterTooManyPairs) {
  Body body(sheet(10, 1)), other(sheet(10, 2));
  body.cover(0.02f);
  expect_complete(body, 0.02f);
  std::swap(body.neighbours, other.neighbours);
  other.cover(0.02f);
  EXPECT_EQ(other.neighbours.searched(), other.surface.vertex_count());
  expect_complete(other, 0.02f);
  body.cover(0.02f);
  body.pairs(false);
  EXPECT_THROW(body.neighbours.add_edges(10, body.scratch), std::length_error);
  body.cover(0.02f);
  EXPECT_EQ(body.neighbours.searched(), body.surface.vertex_count());
  expect_complete(body, 0.02f);
}

}  // namespace THIS_FILE
}  // namespace collide::test
