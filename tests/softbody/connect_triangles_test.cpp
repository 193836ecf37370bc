// The net of springs of a mesh: whatever its resolution, the springs together are as stiff as those of the paper's
// sphere.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "softbody/mesh/mesh.h"

namespace softbody::test {
namespace THIS_FILE {

double area(const Mesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += glm::length(glm::cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a])) / 2;
  return sum;
}

struct Moments {
  double second = 0;  // of the springs' lengths: how stiff their net is against stretching, for its area
  double fourth = 0;  // m^2, the same against bending
  double mean = 0;    // m
};
Moments moments(const Mesh& mesh, const std::vector<Edge>& pairs, const std::vector<double>& shares) {
  Moments m;
  const double whole = area(mesh);
  for (std::size_t s = 0; s < pairs.size(); ++s) {
    const double length = glm::distance(mesh.vertices[pairs[s][0]], mesh.vertices[pairs[s][1]]);
    m.second += shares[s] * std::pow(length, 2) / whole;
    m.fourth += shares[s] * std::pow(length, 4) / whole;
    m.mean += length / double(pairs.size());
  }
  return m;
}
Moments of_bends(const Mesh& mesh) { return moments(mesh, mesh.bend_pairs, mesh.bend_shares); }

/// Returns a sphere whose triangles are up to three times as long as wide, of uneven sizes.
Mesh uneven_sphere(int subdivisions) {
  Mesh mesh = icosphere(subdivisions, 0.5);
  for (glm::dvec3& v : mesh.vertices)
    v = 0.5 * glm::normalize(v + 0.25 * glm::dvec3(std::sin(4 * v.y), std::sin(5 * v.z), std::sin(3 * v.x)));
  connect_triangles(mesh);
  return mesh;
}

/// Returns a flat sheet of equal-sided triangles with sides of 0.1 m.
Mesh triangle_sheet(int columns, int rows) {
  Mesh mesh;
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= columns; ++c)
      mesh.vertices.emplace_back(0.1 * c + 0.05 * (r % 2), 0, 0.05 * std::sqrt(3.0) * r);
  const auto at = [&](int c, int r) { return Index(r * (columns + 1) + c); };
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const int left = r % 2, right = 1 - left;  // the side to which the next row is moved
      mesh.triangles.push_back({at(c, r), at(c + left, r + 1), at(c + 1, r)});
      mesh.triangles.push_back({at(c, r + 1), at(c + 1, r + 1), at(c + right, r)});
    }
  connect_triangles(mesh);
  return mesh;
}

TEST(ConnectTriangles, StretchingIsAsStiffAsInARegularNetOfAnyMesh) {
  for (int s = 0; s <= 4; ++s) {
    const Mesh regular = icosphere(s, 0.7), uneven = uneven_sphere(s);
    EXPECT_NEAR(moments(regular, regular.edges, regular.edge_shares).second, 2 * std::sqrt(3.0), 0.05) << s;
    EXPECT_NEAR(moments(uneven, uneven.edges, uneven.edge_shares).second, 2 * std::sqrt(3.0), 0.005) << s;
  }
}

TEST(ConnectTriangles, AnEdgeOnTheBorderHasHalfOfASpring) {
  const Mesh sheet = triangle_sheet(6, 5);
  EXPECT_FALSE(sheet.closed);
  std::size_t halves = 0;
  for (const double share : sheet.edge_shares) {
    EXPECT_NEAR(share, std::round(2 * share) / 2, 1e-9);
    halves += std::abs(share - 0.5) < 1e-9;
  }
  EXPECT_EQ(halves, 2u * 6 + 2 * 5);
}

TEST(ConnectTriangles, SpringsOfThePapersSphereAreAllAlike) {
  for (int s = 0; s <= 2; ++s) {
    const Mesh mesh = icosphere(s, 0.5);
    EXPECT_EQ(mesh.edge_shares, std::vector<double>(mesh.edges.size(), 1));
    EXPECT_EQ(mesh.bend_shares, std::vector<double>(mesh.bend_pairs.size(), 1));
  }
}

TEST(ConnectTriangles, BendSpringsAreAsLongAndAsStiffTogetherInFinerMeshes) {
  const Moments stated = of_bends(icosphere(2, 0.5));
  for (int s = 3; s <= 4; ++s)
    for (const Mesh& mesh : {icosphere(s, 0.5), uneven_sphere(s)}) {
      const Moments own = of_bends(mesh);
      EXPECT_NEAR(own.mean, stated.mean, 0.05 * stated.mean);
      EXPECT_NEAR(own.second, stated.second, 0.04 * stated.second);
      EXPECT_NEAR(own.fourth, stated.fourth, 0.08 * stated.fourth);
    }
}

TEST(ConnectTriangles, BendSpringsEndAtTheBorder) {
  const Mesh coarse = triangle_sheet(8, 8), fine = triangle_sheet(32, 32);
  EXPECT_EQ(coarse.bend_pairs.size() + 4 * 8, coarse.edges.size());
  for (const auto& [i, j] : fine.bend_pairs) {
    const glm::dvec3 along = fine.vertices[j] - fine.vertices[i];
    EXPECT_LT(glm::length(along), 3.3 / 8 * 1.2);
  }
}

TEST(QuadGrid, BendSpringsAreAsLongInFinerGrids) {
  const Mesh stated = quad_grid(56, 56, 2, 2), finer = quad_grid(112, 112, 2, 2), coarser = quad_grid(28, 28, 2, 2);
  EXPECT_NEAR(of_bends(finer).mean, of_bends(stated).mean, 1e-9);
  EXPECT_NEAR(of_bends(finer).second, of_bends(stated).second, 0.03 * of_bends(stated).second);
  EXPECT_NEAR(of_bends(coarser).second, of_bends(stated).second, 0.04 * of_bends(stated).second);
}

}  // namespace THIS_FILE
}  // namespace softbody::test
