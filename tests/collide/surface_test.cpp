#include "collide/surface/surface.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "collide/surface/box_tree.h"
#include "surface_meshes.h"

namespace collide::test {

using namespace collide::surface;
namespace THIS_FILE {

Surface surface_of(const SurfaceMesh& mesh) { return {static_cast<Index>(mesh.vertices.size()), mesh.triangles}; }

TEST(Surface, ListsItsEdgesAndKnowsWhetherItIsClosed) {
  const Surface sphere = surface_of(ball(1));
  EXPECT_EQ(sphere.edges().size(), 480u);
  EXPECT_TRUE(sphere.closed());
  EXPECT_TRUE(surface_of(valley()).closed());

  const Surface cloth = surface_of(sheet(1, 1));
  EXPECT_EQ(cloth.edges(), (std::vector<Edge>{{0, 1}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}));
  EXPECT_FALSE(cloth.closed());
  EXPECT_FALSE(Surface(3, {}).closed());
}

TEST(Surface, IsNotClosedWithAHoleOrAReversedFace) {
  SurfaceMesh mesh = box(glm::vec3(0), glm::vec3(1));
  std::swap(mesh.triangles[4][0], mesh.triangles[4][1]);
  EXPECT_FALSE(surface_of(mesh).closed());
  mesh.triangles.erase(mesh.triangles.begin() + 4);
  EXPECT_FALSE(surface_of(mesh).closed());
}

TEST(Surface, ThrowsForInvalidTriangles) {
  EXPECT_THROW(Surface(3, {{0, 1, 3}}), std::invalid_argument);
  EXPECT_THROW(Surface(3, {{0, 1, 1}}), std::invalid_argument);
}

TEST(MovingBox, OverlapsUnlessAnAxisSeparatesBothEndsInOneOrder) {
  const Box unit{glm::dvec3(0), glm::dvec3(1)}, beside{glm::dvec3(2, 0, 0), glm::dvec3(3, 1, 1)};
  const Box far{glm::dvec3(9), glm::dvec3(10)}, beside_far{glm::dvec3(11, 9, 9), glm::dvec3(12, 10, 10)};
  EXPECT_FALSE(overlap(MovingBox{unit, far}, {beside, beside_far})) << "they fly together";
  EXPECT_TRUE(overlap(MovingBox{unit, beside}, {beside, unit})) << "they change places";
}

}  // namespace THIS_FILE
}  // namespace collide::test
