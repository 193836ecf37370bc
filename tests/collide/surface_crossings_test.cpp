#include <algorithm>
#include <cmath>

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

TEST(FindCrossings, FindsNoneInANearMiss) {
  const SurfaceMesh cloth = sheet(8, 4);
  const Scene before{moved(ball(0.5f), glm::vec3(0, 1, 0)), cloth};
  EXPECT_EQ(figures_of(before, Scene{moved(ball(0.5f), glm::vec3(3, 0.501f, 0)), cloth}), SurfaceFigures{});
  // Both move far in one step, one behind the other.
  const Scene two{ball(0.5f), moved(ball(0.5f), glm::vec3(1.01f, 0, 0))};
  const Scene flown{moved(ball(0.5f), glm::vec3(900, 0, 0)), moved(ball(0.5f), glm::vec3(901.01f, 0, 0))};
  EXPECT_EQ(figures_of(two, flown), SurfaceFigures{});
}

TEST(FindCrossings, FollowsVerticesAlongStraightLines) {
  // A blade turns by a quarter of a circle beside a sphere. Its tip moves from (0, 0, r) to (r, 0, 0) along the chord,
  // since all vertices move along straight lines.
  const auto turn = [](float length) {
    const SurfaceMesh blade = box(glm::vec3(-0.05f, -0.05f, 0), glm::vec3(0.05f, 0.05f, length));
    const SurfaceMesh obstacle = moved(ball(0.5f), glm::vec3(1.5f, 0, 1.5f));
    const Scene before{blade, obstacle}, after{turned(blade, glm::vec3(0, 1, 0), 1.5707964f), obstacle};
    return std::ranges::any_of(crossings_of(before, after), [](const Crossing& c) { return c.body != c.other; });
  };
  const float chord = (1.5f * std::sqrt(2.0f) - 0.5f) * std::sqrt(2.0f);  // the length whose chord touches the sphere
  EXPECT_FALSE(turn(chord * 0.93f));
  EXPECT_TRUE(turn(chord * 1.05f));
}

TEST(FindCrossings, FindsEdgesThatPassWithoutAnyVertex) {
  // Two narrow strips that cross; one passes through the other.
  const SurfaceMesh strip{{{-5, 0, -0.1f}, {-5, 0, 0.1f}, {5, 0, 0.1f}, {5, 0, -0.1f}}, {{0, 1, 2}, {0, 2, 3}}};
  const SurfaceMesh across = turned(strip, glm::vec3(0, 1, 0), 1.2f);
  const Scene before{strip, moved(across, glm::vec3(0, 1, 0))}, after{strip, moved(across, glm::vec3(0, -1, 0))};
  const SurfaceFigures figures = figures_of(before, after);
  EXPECT_EQ(figures.crossed_vertices, 0u);
  EXPECT_EQ(figures.edge_crossings, 9u);  // two long sides and the diagonal of each
}

TEST(FindCrossings, FindsEdgesOfOneBodyThatPassEachOther) {
  const SurfaceMesh strip{{{-5, 0, -0.1f}, {-5, 0, 0.1f}, {5, 0, 0.1f}, {5, 0, -0.1f}}, {{0, 1, 2}, {0, 2, 3}}};
  const SurfaceMesh across = turned(strip, glm::vec3(0, 1, 0), 1.2f);
  const auto both = [&](float height) {
    SurfaceMesh mesh = strip;
    for (const glm::vec3& v : across.vertices) mesh.vertices.push_back(v + glm::vec3(0, height, 0));
    for (const Triangle& t : across.triangles) mesh.triangles.push_back({t[0] + 4, t[1] + 4, t[2] + 4});
    return Scene{mesh};
  };
  const std::vector<Crossing> crossings = crossings_of(both(1), both(-1));
  EXPECT_TRUE(std::ranges::all_of(crossings, [](const Crossing& c) { return c.body == 0 && c.other == 0; }));
  const SurfaceFigures figures = figures_of(both(1), both(-1));
  EXPECT_EQ(figures.crossed_vertices, 0u);
  EXPECT_EQ(figures.edge_crossings, 9u);  // two long sides and the diagonal of each
}

TEST(FindCrossings, FindsASheetThatPassesThroughItself) {
  SurfaceMesh cloth = sheet(8, 4);
  for (glm::vec3& v : cloth.vertices) {
    if (v.x > 1) v = glm::vec3(1.9f - v.x, 0.5f, v.z * 0.9f);  // folded over
  }
  SurfaceMesh fallen = cloth;
  for (glm::vec3& v : fallen.vertices) {
    if (v.y > 0) v.y = -0.5f;
  }
  const SurfaceFigures figures = figures_of(Scene{cloth}, Scene{fallen});
  EXPECT_GT(figures.crossed_vertices, 10u);
  for (const Crossing& c : crossings_of(Scene{cloth}, Scene{fallen})) EXPECT_EQ(c.body, c.other);
}

TEST(FindCrossings, FindsNoneWithinABodyThatOnlyTranslates) {
  std::mt19937 random(29);
  for (const float way : {0.1f, 30.0f, 1e4f}) {
    SurfaceMesh mesh = ball(1);
    for (glm::vec3& v : mesh.vertices) v = v * uniform(random, 0.9f, 1.1f);
    EXPECT_TRUE(crossings_of(Scene{mesh}, Scene{moved(mesh, glm::vec3(way, -way, 0))}).empty()) << way;
  }
  EXPECT_TRUE(crossings_of(Scene{sheet(8, 4)}, Scene{moved(sheet(8, 4), glm::vec3(0, -3, 1))}).empty());
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
