#include "engine/frame_data.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/engine/shapes.h"

namespace engine {
namespace THIS_FILE {

TEST(SmoothNormals, PointOutwardsOnASphere) {
  const Mesh mesh = icosahedron();
  std::vector<glm::vec3> normals(mesh.positions.size(), glm::vec3(7.0f));
  smooth_normals(mesh.triangles, mesh.positions, normals);
  for (std::size_t i = 0; i < normals.size(); ++i) EXPECT_LT(glm::distance(normals[i], mesh.positions[i]), 1e-5f);
}

TEST(SmoothNormals, PointUpAtAVertexWithoutTriangles) {
  const std::vector<glm::vec3> positions(1, glm::vec3(3.0f));
  std::vector<glm::vec3> normals(1);
  smooth_normals({}, positions, normals);
  EXPECT_EQ(normals[0], glm::vec3(0, 1, 0));
}

}  // namespace THIS_FILE
}  // namespace engine
