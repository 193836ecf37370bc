// Compares inside() with the exact oracle, and nearest_face() with a loop over all faces.

#include "collide/surface/closed_shell.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "collide/surface/closest_features.h"
#include "every_target.h"
#include "surface_meshes.h"

namespace collide::test {

using namespace collide::oracle;
using namespace collide::surface;
namespace THIS_FILE {

TEST(ClosedShell, InsideAgreesWithTheExactOracle) {
  std::mt19937 random(54);
  SurfaceMesh dented = ball(1);
  for (glm::vec3& v : dented.vertices) v *= uniform(random, 0.5f, 1.0f);
  for (const SurfaceMesh& mesh :
       {ball(1), box(glm::vec3(-1), glm::vec3(1)), moved(valley(), {-2, -2, -0.5f}), dented}) {
    const std::vector<glm::vec3> points = random_points(random, 2000, -2, 2);
    Scene scene{mesh};
    scene.add({points, {}});
    std::vector<bool> expected(points.size(), false);
    for (const Penetration& p : overlaps_of(scene).penetrations) expected[p.vertex - mesh.vertices.size()] = true;
    const Points3 at(mesh.vertices);
    const ClosedShell shell(*scene.surfaces[0], at.run());
    int inside = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_EQ(shell.inside(points[i]), expected[i]) << i;
      inside += expected[i];
    }
    EXPECT_GT(inside, 50);
  }
}

TEST(ClosedShell, NearestFaceIsTheFirstAtTheSmallestDistance) {
  for (const SurfaceMesh& mesh : {moved(valley(), {-2, -2, -0.5f}), ball(3), moved(ball(2), {100, 70, -100})}) {
    std::mt19937 random(55);
    const Surface surface(static_cast<Index>(mesh.vertices.size()), mesh.triangles);
    const Points3 at(mesh.vertices);
    const ClosedShell shell(surface, at.run());
    std::vector<glm::vec3> points = mesh.vertices;  // several faces are equally close
    for (const glm::vec3& p : random_points(random, 1000, -1.5, 1.5)) points.push_back(mesh.vertices[0] + p);
    for (const glm::vec3& p : points) {
      Index nearest = 0;
      float smallest = infinity;
      for (Index t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        const glm::vec3 separation =
            closest_vertex_face(p, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]).separation;
        if (const float squared = glm::dot(separation, separation); squared < smallest) smallest = squared, nearest = t;
      }
      EXPECT_EQ(shell.nearest_face(p).face, nearest);
      EXPECT_EQ(shell.nearest_face(p).distance, std::sqrt(smallest));
    }
  }
}

TEST(ClosedShell, NothingIsInsideIfAVertexIsNotFinite) {
  for (const float bad : {infinity, -infinity, nan}) {
    SurfaceMesh mesh = ball(1);
    const Surface surface(static_cast<Index>(mesh.vertices.size()), mesh.triangles);
    const Points3 whole(mesh.vertices);
    EXPECT_TRUE(ClosedShell(surface, whole.run()).inside(glm::vec3(0)));
    EXPECT_FALSE(ClosedShell(surface, whole.run()).inside({0, bad, 0}));
    mesh.vertices[3].y = bad;
    const Points3 at(mesh.vertices);
    EXPECT_FALSE(ClosedShell(surface, at.run()).inside(glm::vec3(0)));
  }
}

}  // namespace THIS_FILE
}  // namespace collide::test
