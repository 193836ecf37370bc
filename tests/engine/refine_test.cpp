#include "engine/render/refine.h"

#include <gtest/gtest.h>

#include "engine/frame_data.h"
#include "tests/engine/shapes.h"

namespace engine {
namespace {

TEST(Refine, OneCutLeavesTheMeshAsItIs) {
  const Mesh mesh = icosahedron();
  const RefinedMesh refined = refine(mesh.triangles, 12, 1);
  EXPECT_EQ(refined.vertices.size(), 12u);
  EXPECT_EQ(refined.indices, mesh.triangles);
}

TEST(Refine, SharesThePointsOnEdges) {
  for (const int cuts : {2, 3, 4, 8}) {
    const RefinedMesh refined = refine(icosahedron().triangles, 12, cuts);
    const auto n = static_cast<std::size_t>(cuts * cuts);
    EXPECT_EQ(refined.indices.size(), 3 * 20 * n);
    EXPECT_EQ(refined.vertices.size(), 10 * n + 2);  // Euler's formula
    EXPECT_TRUE(is_closed(refined.indices));
  }
}

TEST(Refine, OnlyVerticesOfTheMeshRepeatTheirFirstCorner) {
  const RefinedMesh refined = refine(icosahedron().triangles, 12, 4);
  for (std::size_t i = 0; i < refined.vertices.size(); ++i) {
    const auto& corners = refined.vertices[i].corners;
    EXPECT_EQ(corners[0] == corners[1], i < 12) << i;
  }
}

TEST(Refine, KnowsClosedMeshesFromOpenOnes) {
  Mesh mesh = icosahedron();
  EXPECT_TRUE(is_closed(mesh.triangles));
  mesh.triangles.resize(mesh.triangles.size() - 3);
  EXPECT_FALSE(is_closed(mesh.triangles));
  EXPECT_FALSE(is_closed({}));
}

TEST(SmoothNormals, PointOutwardsOnASphere) {
  const Mesh mesh = icosahedron();
  std::vector<glm::vec3> normals(mesh.positions.size(), glm::vec3(7.0f));
  smooth_normals(mesh.triangles, mesh.positions, normals);
  for (std::size_t i = 0; i < normals.size(); ++i) EXPECT_LT(glm::distance(normals[i], mesh.positions[i]), 1e-5f);
}

TEST(SmoothNormals, VertexWithoutTrianglesPointsUp) {
  const std::vector<glm::vec3> positions(1, glm::vec3(3.0f));
  std::vector<glm::vec3> normals(1);
  smooth_normals({}, positions, normals);
  EXPECT_EQ(normals[0], glm::vec3(0, 1, 0));
}

}  // namespace
}  // namespace engine
