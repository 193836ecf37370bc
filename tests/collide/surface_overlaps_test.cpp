#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "surface_meshes.h"

namespace collide::test {

using namespace collide::oracle;
using namespace collide::surface;
namespace THIS_FILE {

bool vertex_is_inside(const Overlaps& overlaps, Index vertex) {
  return std::any_of(overlaps.penetrations.begin(), overlaps.penetrations.end(),
                     [&](const Penetration& in) { return in.vertex == vertex; });
}

/// Adds a body of points without a surface.
void add_points(Scene& scene, const std::vector<glm::vec3>& points) {
  scene.state.add(points);
  scene.surfaces.push_back(nullptr);
}

TEST(FindOverlaps, AVertexOnAFaceSideOrCornerIsNotInside) {
  for (const float scale : {1.0f, 0.37f}) {
    SurfaceMesh cube = box(glm::vec3(0), glm::vec3(4 * scale));
    Scene scene{cube};
    std::vector<glm::vec3> points = cube.vertices;
    for (const auto& [a, b, c] : cube.triangles) {
      points.push_back((cube.vertices[a] + cube.vertices[b]) * 0.5f);
      points.push_back((cube.vertices[a] * 2.0f + cube.vertices[b] + cube.vertices[c]) * 0.25f);
    }
    add_points(scene, points);
    EXPECT_TRUE(overlaps_of(scene).penetrations.empty());
    // One unit in the last place farther in, they are inside.
    for (glm::vec3& p : points)
      for (int axis = 0; axis < 3; ++axis) p[axis] = std::nextafter(p[axis], 2 * scale);
    Scene within{cube};
    add_points(within, points);
    EXPECT_EQ(overlaps_of(within).penetrations.size(), points.size());
  }
}

/// Returns the solid angle of the mesh as seen from p, divided by 4 pi. Van Oosterom and Strackee 1983.
long double winding_number(const SurfaceMesh& mesh, const glm::vec3& p) {
  long double sum = 0;
  for (const Triangle& triangle : mesh.triangles) {
    std::array<glm::vec<3, long double>, 3> v;
    std::array<long double, 3> l;
    for (std::size_t k = 0; k < 3; ++k) {
      v[k] = glm::vec<3, long double>(mesh.vertices[triangle[k]]) - glm::vec<3, long double>(p);
      l[k] = glm::length(v[k]);
    }
    sum += 2 * std::atan2(glm::dot(v[0], glm::cross(v[1], v[2])), l[0] * l[1] * l[2] + glm::dot(v[0], v[1]) * l[2] +
                                                                      glm::dot(v[1], v[2]) * l[0] +
                                                                      glm::dot(v[2], v[0]) * l[1]);
  }
  return sum / (4 * std::numbers::pi_v<long double>);
}

SurfaceMesh crumpled(std::mt19937& random, float origin) {
  SurfaceMesh mesh = ball(1);
  for (glm::vec3& v : mesh.vertices) v = v * uniform(random, 0.2f, 1.6f) + glm::vec3(origin);
  return mesh;
}

TEST(FindOverlaps, InsideMeansThatTheWindingNumberIsNotZero) {
  std::mt19937 random(25);
  int inside = 0;
  for (const float origin : {0.0f, 1e4f}) {
    for (const bool inverted : {false, true}) {
      SurfaceMesh mesh = crumpled(random, origin);
      if (inverted) {
        for (Triangle& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
      }
      Scene scene{mesh};
      const std::vector<glm::vec3> points = random_points(random, 1000, origin - 1.3f, origin + 1.3f);
      add_points(scene, points);
      const Overlaps overlaps = overlaps_of(scene);
      for (Index k = 0; k < points.size(); ++k) {
        const long double windings = winding_number(mesh, points[k]);
        const bool on_surface = std::abs(windings - std::round(windings)) > 0.01L;
        if (on_surface) continue;
        ASSERT_EQ(vertex_is_inside(overlaps, 162 + k), std::round(windings) != 0) << k;
      }
      inside += static_cast<int>(overlaps.penetrations.size());
    }
  }
  EXPECT_GT(inside, 300);
}

TEST(FindOverlaps, AVertexWithWindingNumberTwoIsInside) {
  SurfaceMesh twice = ball(1, 1);
  SurfaceMesh again = ball(0.5f, 1);
  for (Triangle t : again.triangles) twice.triangles.push_back({t[0] + 42, t[1] + 42, t[2] + 42});
  twice.vertices.insert(twice.vertices.end(), again.vertices.begin(), again.vertices.end());
  Scene scene{twice};
  add_points(scene, {glm::vec3(0.1f), glm::vec3(0.4f), glm::vec3(1)});
  const Overlaps overlaps = overlaps_of(scene);
  ASSERT_EQ(overlaps.penetrations.size(), 2u);
  EXPECT_LT(overlaps.penetrations[0].depth, 0.5);  // to the inner sheet
}

TEST(FindOverlaps, DepthIsTheSmallestOverAllFaces) {
  std::mt19937 random(26);
  const SurfaceMesh mesh = crumpled(random, 0);
  Scene scene{mesh};
  add_points(scene, random_points(random, 300, -0.8f, 0.8f));
  const Overlaps overlaps = overlaps_of(scene);
  ASSERT_GT(overlaps.penetrations.size(), 50u);
  const auto at = [&](Index v) { return glm::dvec3(scene.at(v)); };
  for (const Penetration& in : overlaps.penetrations) {
    const glm::dvec3 p = at(in.vertex);
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : mesh.triangles) nearest = std::min(nearest, distance_to_face(p, at(a), at(b), at(c)));
    EXPECT_NEAR(in.depth, nearest, 1e-12);
    EXPECT_EQ(in.body, 0u);
    EXPECT_LT(glm::length(p + in.depth * in.normal - in.point), 1e-12);
    EXPECT_NEAR(glm::length(in.normal), 1, 1e-12);
  }
}

TEST(FindOverlaps, NamesTheFirstOfEquallyNearFaces) {
  for (const bool reversed : {false, true}) {
    SurfaceMesh cube = box(glm::vec3(0), glm::vec3(4));
    if (reversed) std::ranges::reverse(cube.triangles);
    Scene scene{cube};
    add_points(scene, {glm::vec3(2), {2, 3, 2}});  // in the centre, and below the diagonal of the upper side
    const Overlaps overlaps = overlaps_of(scene);
    ASSERT_EQ(overlaps.penetrations.size(), 2u);
    EXPECT_EQ(overlaps.penetrations[0].triangle, 0u) << reversed;
    EXPECT_EQ(overlaps.penetrations[1].triangle, reversed ? 4u : 6u);
  }
}

TEST(FindOverlaps, FindsASheetThroughASphere) {
  const SurfaceFigures figures = figures_of(Scene{ball(1), moved(sheet(1, 10), glm::vec3(0, 0.3f, 0))});
  EXPECT_EQ(figures.penetrating_vertices, 0u);  // the sheet's corners are far outside, and it has no inside
  EXPECT_GT(figures.piercings, 8u);
  EXPECT_EQ(figures.overlapping_pairs, 1u);
}

TEST(FindOverlaps, FindsASheetFoldedThroughItself) {
  SurfaceMesh cloth = sheet(4, 4);
  EXPECT_EQ(figures_of(Scene{cloth}), SurfaceFigures{});
  for (Index k = 20; k < 25; ++k) cloth.vertices[k] = {cloth.vertices[k].x + 0.1f, -0.5f, -1.3f};
  EXPECT_TRUE(overlaps_of(Scene{cloth}).piercings.empty()) << "the last row is below the second one";
  for (Index k = 15; k < 20; ++k) cloth.vertices[k] = {cloth.vertices[k].x, 0.5f, -1.2f};
  const SurfaceFigures figures = figures_of(Scene{cloth});
  EXPECT_GT(figures.piercings, 3u);
  EXPECT_EQ(figures.self_intersecting_bodies, 1u);
  EXPECT_EQ(figures.overlapping_pairs, 0u);
}

// Touching is not penetrating.

TEST(FindOverlaps, EqualAndStackedBoxesDoNotOverlap) {
  const SurfaceMesh below = box(glm::vec3(0), glm::vec3(4));
  EXPECT_EQ(figures_of(Scene{below, below}), SurfaceFigures{});
  const std::vector<SurfaceMesh> above{
      box(glm::vec3(0, 4, 0), glm::vec3(4, 8, 4)), box(glm::vec3(1, 4, 1), glm::vec3(3, 8, 3)),
      box(glm::vec3(2, 4, 2), glm::vec3(6, 8, 6)),  // its lower sides cross the sides of the upper face
      box(glm::vec3(4, 4, 0), glm::vec3(8, 8, 4))};
  for (const SurfaceMesh& mesh : above) {
    EXPECT_EQ(figures_of(Scene{below, mesh}), SurfaceFigures{});
    EXPECT_EQ(figures_of(Scene{below, moved(mesh, glm::vec3(0, 0.5f, 0))}), SurfaceFigures{});
  }
  EXPECT_EQ(figures_of(Scene{below, moved(above[2], glm::vec3(0, -0x1p-21f, 0))}).overlapping_pairs, 1u);
}

/// Returns a mesh with one edge: the first side of a face without area.
SurfaceMesh needle(const glm::vec3& p, const glm::vec3& q) { return {{p, q, q}, {{0, 1, 2}}}; }

struct Needle {
  glm::vec3 from, to;
  bool passes;
};

TEST(FindOverlaps, AnEdgeThroughASideOrCornerPassesButAGrazingEdgeDoesNot) {
  const SurfaceMesh cube = box(glm::vec3(0), glm::vec3(4));
  const std::vector<Needle> needles{{{2, 6, 2}, {2, 2, 2}, true},      // through the diagonal of the upper face
                                    {{2, 6, 1}, {2, 4, 1}, false},     // ends on a face
                                    {{6, 6, 2}, {2, 2, 2}, true},      // through the ridge between two faces
                                    {{6, 2, 2}, {2, 6, 2}, false},     // grazes that ridge
                                    {{6, 6, 6}, {2, 2, 2}, true},      // through a corner
                                    {{8, 4, 0}, {0, 4, 8}, false},     // grazes that corner
                                    {{1, 4, 1}, {6, 4, 2}, false},     // leaves within the upper face
                                    {{0, 5, 0}, {0, -1, 0}, false},    // along a ridge
                                    {{-1, 2, -1}, {5, 2, 5}, true},    // through two ridges
                                    {{-1, -1, -1}, {5, 5, 5}, true}};  // through two corners
  for (const Needle& n : needles) {
    for (const bool reversed : {false, true}) {
      const SurfaceMesh edge = reversed ? needle(n.to, n.from) : needle(n.from, n.to);
      EXPECT_EQ(!overlaps_of(Scene{edge, cube}).piercings.empty(), n.passes) << n.from.x << n.from.y << n.from.z;
    }
  }
}

TEST(FindOverlaps, NoEdgePassesThroughTheBorderOfASheet) {
  const SurfaceMesh cloth = sheet(2, 4);
  const auto passes = [&](float x, float z) {
    return !overlaps_of(Scene{cloth, needle({x, 1, z}, {x, -1, z})}).piercings.empty();
  };
  EXPECT_TRUE(passes(0, 0));     // the vertex in the centre
  EXPECT_TRUE(passes(0, 1));     // a side of two faces
  EXPECT_FALSE(passes(2, 1));    // the border
  EXPECT_FALSE(passes(-2, -2));  // its corner
  EXPECT_TRUE(passes(1.999f, 1));
}

TEST(FindOverlaps, FacesWithoutAreaChangeNothing) {
  // One face of a cube is cut at the midpoint of a side. A face without area closes the gap to the face on the other
  // side.
  SurfaceMesh cube = box(glm::vec3(0), glm::vec3(4));
  const auto [a, b, c] = cube.triangles[0];
  const auto midpoint = static_cast<Index>(cube.vertices.size());
  cube.vertices.push_back((cube.vertices[a] + cube.vertices[b]) * 0.5f);
  cube.triangles[0] = {a, midpoint, c};
  cube.triangles.push_back({midpoint, b, c});
  cube.triangles.push_back({a, b, midpoint});
  Scene scene{cube};
  EXPECT_TRUE(scene.surfaces[0]->closed());
  add_points(scene, {cube.vertices[midpoint], glm::vec3(0.1f, 1, 1), glm::vec3(-0.1f, 1, 1)});
  const Overlaps overlaps = overlaps_of(scene);
  ASSERT_EQ(overlaps.penetrations.size(), 1u);
  EXPECT_EQ(overlaps.penetrations[0].vertex, 10u);
  EXPECT_NEAR(overlaps.penetrations[0].depth, 0.1, 1e-7);

  const SurfaceMesh point{std::vector<glm::vec3>(4, glm::vec3(1)), {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3}}};
  EXPECT_EQ(figures_of(Scene{point, point}), SurfaceFigures{});
  EXPECT_EQ(figures_of(Scene{point, box(glm::vec3(0), glm::vec3(4))}).penetrating_vertices, 4u);
}

}  // namespace THIS_FILE
}  // namespace collide::test
