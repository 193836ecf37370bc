// Meshes: counts, topology, orientation.

#include "softbody/mesh/mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <set>

namespace softbody {
namespace THIS_FILE {

TEST(Icosphere, IsAClosedSphereThatFacesOutward) {
  for (int s = 0; s <= 4; ++s) {
    SCOPED_TRACE(s);
    const std::size_t quarter = std::size_t(1) << (2 * s);
    const Mesh mesh = icosphere(s, 0.7);
    EXPECT_EQ(mesh.vertices.size(), 10 * quarter + 2);
    EXPECT_EQ(mesh.triangles.size(), 20 * quarter);
    EXPECT_EQ(mesh.edges.size(), 30 * quarter);
    EXPECT_GT(mesh.bend_pairs.size(), 27 * quarter);
    EXPECT_TRUE(mesh.closed && mesh.shear_pairs.empty());
    for (const auto* pairs : {&mesh.edges, &mesh.bend_pairs}) {
      for (const auto& [i, j] : *pairs) EXPECT_LT(i, j);
      for (std::size_t k = 1; k < pairs->size(); ++k) EXPECT_LT((*pairs)[k - 1], (*pairs)[k]);
    }
    std::set<std::pair<Index, Index>> directed;
    for (const Triangle& t : mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k) EXPECT_TRUE(directed.insert({t[k], t[(k + 1) % 3]}).second);
      const auto &p = mesh.vertices[t[0]], &q = mesh.vertices[t[1]], &r = mesh.vertices[t[2]];
      EXPECT_GT(glm::dot(glm::cross(q - p, r - p), p + q + r), 0.0);
    }
    EXPECT_EQ(directed.size(), 2 * mesh.edges.size()) << "each edge runs once in each direction";
    for (const auto& [a, b] : directed) EXPECT_TRUE(directed.contains({b, a}));
    for (const auto& v : mesh.vertices) EXPECT_NEAR(glm::length(v), 0.7, 1e-14);
    EXPECT_NEAR(bounding_radius(mesh), 0.7, 1e-12);
  }
}

/// Finer ones have longer bend pairs (connect_triangles_test.cpp).
TEST(Icosphere, HasBendPairsOfTheCornersOppositeAnEdge) {
  for (int s = 0; s <= 2; ++s) {
    const Mesh mesh = icosphere(s, 1.0);
    std::map<std::set<Index>, std::set<Index>> across;
    for (const Triangle& t : mesh.triangles)
      for (std::size_t k = 0; k < 3; ++k) across[{t[k], t[(k + 1) % 3]}].insert(t[(k + 2) % 3]);
    std::set<std::set<Index>> expected, found;
    for (const auto& [edge, opposite] : across) expected.insert(opposite);
    for (const auto& [i, j] : mesh.bend_pairs) found.insert({i, j});
    EXPECT_EQ(found, expected);
  }
}

/// The test compares it with points all over each face.
TEST(CoveringRadius, IsTheLargestDistanceFromTheNearestCorner) {
  constexpr int cuts = 200;
  for (const glm::dvec3 top : {glm::dvec3(0.5, 0.9, 0), glm::dvec3(0.5, 0.5, 0), glm::dvec3(0.3, 0.1, 0.1),
                               glm::dvec3(-0.7, 0.2, 0), glm::dvec3(1.9, 0, 0), glm::dvec3(0)}) {
    Mesh mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, top};
    mesh.triangles = {{0, 1, 2}};
    double farthest = 0;
    for (int i = 0; i <= cuts; ++i)
      for (int j = 0; i + j <= cuts; ++j) {
        const glm::dvec3 p = double(i) / cuts * mesh.vertices[1] + double(j) / cuts * top;
        double nearest = glm::length(p);
        for (const glm::dvec3& corner : mesh.vertices) nearest = std::min(nearest, glm::distance(p, corner));
        farthest = std::max(farthest, nearest);
      }
    EXPECT_GE(covering_radius(mesh), farthest - 1e-12) << top.x;
    EXPECT_LE(covering_radius(mesh), farthest + 0.02) << top.x;
  }
}

TEST(IcosphereVolume, ConvergesToTheSphereFromBelow) {
  const double sphere = 4.0 / 3 * std::numbers::pi * 0.125;
  double last_error = sphere;
  for (int s = 0; s <= 4; ++s) {
    const Mesh mesh = icosphere(s, 0.5);
    const double error = sphere - volume(mesh.vertices, mesh.triangles);
    EXPECT_GT(error, 0.0);
    EXPECT_LT(error, last_error / (s == 0 ? 1 : 3)) << "second order: about a quarter each time";
    last_error = error;
  }
  EXPECT_LT(last_error / sphere, 0.005);
}

TEST(QuadGrid, HasTheCountsOfItsColumnsAndRows) {
  for (const auto& [c, r] : {std::pair(5u, 3u), {1u, 1u}}) {
    const Mesh mesh = quad_grid(int(c), int(r), 2.0, 1.0);
    EXPECT_EQ(mesh.vertices.size(), (c + 1) * (r + 1));
    EXPECT_EQ(mesh.triangles.size(), 2 * c * r);
    EXPECT_EQ(mesh.edges.size(), c * (r + 1) + r * (c + 1));
    EXPECT_EQ(mesh.shear_pairs.size(), 2 * c * r);
    EXPECT_EQ(mesh.bend_pairs.size(), (c - 1) * (r + 1) + (r - 1) * (c + 1));
    EXPECT_FALSE(mesh.closed);
  }
}

TEST(QuadGrid, EdgesAreSidesShearPairsDiagonalsAndBendPairsSkipOneParticle) {
  const Mesh mesh = quad_grid(4, 6, 4 * 0.5, 6 * 0.25);  // quads of 0.5 x 0.25
  const auto apart = [&](const Edge& e) {
    const glm::dvec3 d = glm::abs(mesh.vertices[e[0]] - mesh.vertices[e[1]]);
    return std::pair(int(std::lround(d.x / 0.5)), int(std::lround(d.z / 0.25)));
  };
  for (const Edge& e : mesh.edges) EXPECT_TRUE(apart(e) == std::pair(1, 0) || apart(e) == std::pair(0, 1));
  for (const Edge& e : mesh.shear_pairs) EXPECT_EQ(apart(e), std::pair(1, 1));
  for (const Edge& e : mesh.bend_pairs) EXPECT_TRUE(apart(e) == std::pair(2, 0) || apart(e) == std::pair(0, 2));
}

TEST(QuadGrid, LiesFlatAroundItsOriginAndFacesUp) {
  const Mesh mesh = quad_grid(3, 3, 3.0, 1.5);
  glm::dvec3 mean(0.0);
  double area = 0;
  for (const auto& v : mesh.vertices) mean += v;
  EXPECT_NEAR(glm::length(mean), 0.0, 1e-12);
  for (const auto& [a, b, c] : mesh.triangles) {
    const glm::dvec3 n = glm::cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
    EXPECT_GT(n.y, 0.0);
    area += glm::length(n) / 2;
  }
  EXPECT_NEAR(area, 3.0 * 1.5, 1e-12);
}

TEST(Volume, IsSignedAndTheSameWhereverTheMeshIs) {
  const std::vector<Triangle> faces{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  for (const glm::dvec3& at : {glm::dvec3(0.0), glm::dvec3(3, -2, 7)})
    for (const double x : {2.0, -2.0})  // mirrored: inside out
      EXPECT_NEAR(volume({at, at + glm::dvec3(x, 0, 0), at + glm::dvec3(0, 3, 0), at + glm::dvec3(0, 0, 4)}, faces),
                  x * 3 * 4 / 6, 1e-12);
}

}  // namespace THIS_FILE
}  // namespace softbody
