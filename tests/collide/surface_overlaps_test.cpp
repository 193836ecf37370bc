#include <cmath>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "surface_meshes.h"

namespace collide::test {
namespace {

TEST(SurfaceOverlaps, DepthOfTwoSpheresIsThatOfTheSpheresBelowTheirFaces) {
  for (const float distance : {1.9f, 1.6f, 1.2f}) {
    const Scene scene{ball(1, 3), moved(ball(1, 3), glm::vec3(distance, 0, 0))};
    const Overlaps overlaps = overlaps_of(scene);
    const SurfaceFigures figures = figures_of(scene.frame(), overlaps);
    const double faces_within = 0.006;  // the faces lie up to so much below the sphere, at 642 vertices
    EXPECT_NEAR(figures.deepest, 2 - double{distance}, 2 * faces_within) << distance;
    EXPECT_EQ(figures.overlapping_pairs, 1u);
    EXPECT_EQ(figures.self_intersecting_bodies, 0u);
    EXPECT_GT(figures.piercings, 0u);
    for (const Penetration& in : overlaps.penetrations) {
      const glm::dvec3 centre(in.body == 0 ? 0 : double{distance}, 0, 0);
      const double true_depth = 1 - glm::length(glm::dvec3(scene.at(in.vertex)) - centre);
      EXPECT_NEAR(in.depth, true_depth, faces_within);
      EXPECT_GT(glm::dot(in.normal, glm::normalize(in.point - centre)), 0.95);
    }
  }
}

TEST(SurfaceOverlaps, CubeInCube) {
  const Scene scene{box(glm::vec3(0), glm::vec3(4)), box(glm::vec3(1), glm::vec3(2))};
  const Overlaps overlaps = overlaps_of(scene);
  ASSERT_EQ(overlaps.penetrations.size(), 8u);
  EXPECT_TRUE(overlaps.piercings.empty());
  for (const Penetration& in : overlaps.penetrations) {
    EXPECT_EQ(in.body, 0u);
    const glm::vec3 p = scene.at(in.vertex);
    EXPECT_EQ(in.depth, std::min({p.x, p.y, p.z, 4 - p.x, 4 - p.y, 4 - p.z}));
    EXPECT_EQ(glm::dvec3(p) + in.depth * in.normal, in.point);
  }
}

TEST(SurfaceOverlaps, SeparateBodiesDoNot) {
  EXPECT_EQ(figures_of(Scene{ball(1), moved(ball(1), glm::vec3(1.5f, 1.5f, 0))}), SurfaceFigures{});
}

TEST(SurfaceOverlaps, SheetThroughASphere) {
  const SurfaceFigures figures = figures_of(Scene{ball(1), moved(sheet(1, 10), glm::vec3(0, 0.3f, 0))});
  EXPECT_EQ(figures.penetrating_vertices, 0u);  // the sheet's corners are far outside, and it has no inside
  EXPECT_GT(figures.piercings, 8u);
  EXPECT_EQ(figures.overlapping_pairs, 1u);
}

}  // namespace
}  // namespace collide::test
