#include <algorithm>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "surface_meshes.h"

namespace collide::test {

using namespace collide::oracle;
using namespace collide::surface;
namespace THIS_FILE {

using Kind = Crossing::Kind;

TEST(FindCrossings, CountsEachVertexOfASphereThatPassesThroughASheet) {
  for (const glm::vec3& origin : {glm::vec3(0), glm::vec3(1e6f, 1e6f, -1e6f)}) {
    for (const float way : {2.0f, 50.0f, 1000.0f}) {
      const SurfaceMesh cloth = moved(sheet(8, 4), origin), sphere = moved(ball(0.5f), origin);
      const Scene before{moved(sphere, glm::vec3(0.125f, 1, 0.25f)), cloth};
      const Scene after{moved(sphere, glm::vec3(0.125f, 1 - way, 0.25f)), cloth};
      const SurfaceFigures figures = figures_of(before, after);
      EXPECT_EQ(figures.crossed_vertices, 162u + 4u) << way;  // of the ball, and of the sheet below it
      EXPECT_EQ(figures.penetrating_vertices, 0u);
    }
  }
}

TEST(FindCrossings, FindsEntryAndExitOfASphereThroughASphere) {
  std::mt19937 random(28);
  for (int i = 0; i < 5; ++i) {
    const glm::vec3 way = glm::normalize(random_points(random, 1, -1, 1)[0]) * 5.0f;
    const glm::vec3 beside = random_points(random, 1, -0.1f, 0.1f)[0];
    const Scene before{moved(ball(0.3f, 1), beside - way), ball(1)}, after{moved(ball(0.3f, 1), beside + way), ball(1)};
    const std::vector<Crossing> crossings = crossings_of(before, after);
    for (Index v = 0; v < 42; ++v) {  // each goes in and out
      for (const bool inward : {true, false}) {
        EXPECT_TRUE(std::any_of(crossings.begin(), crossings.end(), [&](const Crossing& c) {
          return c.kind == Kind::vertex_face && c.feature[0] == v && c.inward == inward && (c.time < 0.5) == inward;
        }));
      }
    }
  }
}

/// Two narrow strips that cross, of two bodies or of one; one passes through the other.
TEST(FindCrossings, FindsEdgesThatPassWithoutAnyVertex) {
  const SurfaceMesh strip{{{-5, 0, -0.1f}, {-5, 0, 0.1f}, {5, 0, 0.1f}, {5, 0, -0.1f}}, {{0, 1, 2}, {0, 2, 3}}};
  const SurfaceMesh across = turned(strip, glm::vec3(0, 1, 0), 1.2f);
  const auto of_one_body = [&](float height) {
    SurfaceMesh mesh = strip;
    for (const glm::vec3& v : across.vertices) mesh.vertices.push_back(v + glm::vec3(0, height, 0));
    for (const Triangle& t : across.triangles) mesh.triangles.push_back({t[0] + 4, t[1] + 4, t[2] + 4});
    return Scene{mesh};
  };
  const auto of_two = [&](float height) { return Scene{strip, moved(across, glm::vec3(0, height, 0))}; };
  for (const bool one : {true, false}) {
    const Scene before = one ? of_one_body(1) : of_two(1), after = one ? of_one_body(-1) : of_two(-1);
    const SurfaceFigures figures = figures_of(before, after);
    EXPECT_EQ(figures.crossed_vertices, 0u);
    EXPECT_EQ(figures.edge_crossings, 9u) << "two long sides and the diagonal of each";
    for (const Crossing& c : crossings_of(before, after)) EXPECT_EQ(c.body == c.other, one);
  }
}

TEST(FindCrossings, CountsAPassageOverTwoFramesOnce) {
  const SurfaceMesh cloth = sheet(1, 4), cube = box(glm::vec3(-1), glm::vec3(1));
  const auto crossed = [&](float from, float to) {
    return figures_of(Scene{moved(cube, {0.3f, from, 0.1f}), cloth}, Scene{moved(cube, {0.3f, to, 0.1f}), cloth})
        .crossed_vertices;
  };
  // At height 1, the lower face of the cube lies in the plane of the sheet.
  EXPECT_EQ(crossed(1.5f, 1), 0u);
  EXPECT_EQ(crossed(1, 0.5f), 4u);
  EXPECT_EQ(crossed(0.5f, 1), 4u);
  EXPECT_EQ(crossed(1, 1.5f), 0u);
}

}  // namespace THIS_FILE
}  // namespace collide::test
