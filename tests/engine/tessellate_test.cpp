#include "engine/render/tessellate.h"

#include <gtest/gtest.h>

#include "tests/engine/shapes.h"

namespace engine::render {
namespace THIS_FILE {

TEST(Tessellate, FactorOneKeepsTheMesh) {
  const Mesh mesh = icosahedron();
  const TessellatedMesh tessellated = tessellate(mesh.triangles, 12, 1);
  EXPECT_EQ(tessellated.vertices.size(), 12u);
  EXPECT_EQ(tessellated.indices, mesh.triangles);
}

TEST(Tessellate, TrianglesShareThePointsOnTheirEdges) {
  for (const int factor : {2, 3, 4, 8}) {
    const TessellatedMesh tessellated = tessellate(icosahedron().triangles, 12, factor);
    const auto n = static_cast<std::size_t>(factor * factor);
    EXPECT_EQ(tessellated.indices.size(), 3 * 20 * n);
    EXPECT_EQ(tessellated.vertices.size(), 10 * n + 2);  // Euler's formula
    EXPECT_TRUE(is_closed(tessellated.indices));
  }
}

TEST(Tessellate, OnlyVerticesOfTheMeshHaveTwoEqualFirstCorners) {
  const TessellatedMesh tessellated = tessellate(icosahedron().triangles, 12, 4);
  for (std::size_t i = 0; i < tessellated.vertices.size(); ++i) {
    const auto& corners = tessellated.vertices[i].corners;
    EXPECT_EQ(corners[0] == corners[1], i < 12) << i;
  }
}

TEST(IsClosed, TellsClosedMeshesFromOpenOnes) {
  Mesh mesh = icosahedron();
  EXPECT_TRUE(is_closed(mesh.triangles));
  mesh.triangles.resize(mesh.triangles.size() - 3);
  EXPECT_FALSE(is_closed(mesh.triangles));
  EXPECT_FALSE(is_closed({}));
}

}  // namespace THIS_FILE
}  // namespace engine::render
