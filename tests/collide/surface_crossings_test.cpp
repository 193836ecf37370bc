#include <gtest/gtest.h>

#include "surface_meshes.h"

namespace collide::test {
namespace {

TEST(SurfaceCrossings, SphereRightThroughASheet) {
  for (const float speed : {2.0f, 50.0f, 1000.0f}) {
    const SurfaceMesh cloth = sheet(8, 4);
    const Scene before{moved(ball(0.5f), glm::vec3(0.1f, 1, 0.2f)), cloth};
    const Scene after{moved(ball(0.5f), glm::vec3(0.1f, 1 - speed, 0.2f)), cloth};
    const SurfaceFigures figures = figures_of(before, after);
    EXPECT_EQ(figures.crossed_vertices, 162u + 3u) << speed;  // the ball's, and the sheet's below it
    EXPECT_EQ(figures.crossed_pairs, 1u);
    EXPECT_EQ(figures.penetrating_vertices, 0u);
  }
}

TEST(SurfaceCrossings, ANearMissIsNone) {
  const SurfaceMesh cloth = sheet(8, 4);
  const Scene before{moved(ball(0.5f), glm::vec3(0, 1, 0)), cloth};
  EXPECT_EQ(figures_of(before, Scene{moved(ball(0.5f), glm::vec3(3, 0.501f, 0)), cloth}), SurfaceFigures{});
}

}  // namespace
}  // namespace collide::test
