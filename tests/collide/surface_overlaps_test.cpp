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

TEST(FindOverlaps, MeasuresTheDepthOfTwoSpheres) {
  for (const float distance : {1.9f, 1.6f, 1.2f}) {
    const Scene scene{ball(1, 3), moved(ball(1, 3), glm::vec3(distance, 0, 0))};
    const Overlaps overlaps = overlaps_of(scene);
    const SurfaceFigures figures = figures_of(scene.frame(), overlaps);
    const double max_sagitta = 0.006;  // m: with 642 vertices, the faces lie up to this much below the sphere
    EXPECT_NEAR(figures.deepest, 2 - double{distance}, 2 * max_sagitta) << distance;
    EXPECT_EQ(figures.overlapping_pairs, 1u);
    EXPECT_EQ(figures.self_intersecting_bodies, 0u);
    EXPECT_GT(figures.piercings, 0u);
    for (const Penetration& in : overlaps.penetrations) {
      const glm::dvec3 centre(in.body == 0 ? 0 : double{distance}, 0, 0);
      const double true_depth = 1 - glm::length(glm::dvec3(scene.at(in.vertex)) - centre);
      EXPECT_NEAR(in.depth, true_depth, max_sagitta);
      EXPECT_GT(glm::dot(in.normal, glm::normalize(in.point - centre)), 0.95);
    }
  }
}

TEST(FindOverlaps, FindsACubeInsideACube) {
  for (const glm::vec3& origin : {glm::vec3(0), glm::vec3(1e6f, -1e6f, 1e6f)}) {
    const Scene scene{moved(box(glm::vec3(0), glm::vec3(4)), origin), moved(box(glm::vec3(1), glm::vec3(2)), origin)};
    const Overlaps overlaps = overlaps_of(scene);
    ASSERT_EQ(overlaps.penetrations.size(), 8u);
    EXPECT_TRUE(overlaps.piercings.empty());
    for (const Penetration& in : overlaps.penetrations) {
      EXPECT_EQ(in.body, 0u);
      const glm::vec3 p = scene.at(in.vertex) - origin;
      EXPECT_EQ(in.depth, std::min({p.x, p.y, p.z, 4 - p.x, 4 - p.y, 4 - p.z}));
      EXPECT_EQ(glm::dvec3(scene.at(in.vertex)) + in.depth * in.normal, in.point);
    }
  }
}

TEST(FindOverlaps, FindsNothingBetweenSeparateBodies) {
  EXPECT_EQ(figures_of(Scene{ball(1), moved(ball(1), glm::vec3(1.5f, 1.5f, 0))}), SurfaceFigures{});
  EXPECT_EQ(figures_of(Scene{}), SurfaceFigures{});
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
    std::vector<glm::vec3> deeper;
    for (const glm::vec3& p : points) {
      glm::vec3 q;
      for (int axis = 0; axis < 3; ++axis) q[axis] = std::nextafter(p[axis], 2 * scale);
      deeper.push_back(q);
    }
    Scene within{cube};
    add_points(within, deeper);
    EXPECT_EQ(overlaps_of(within).penetrations.size(), deeper.size());
  }
}

TEST(FindOverlaps, AVertexInAConcavityIsOutside) {
  Scene scene{valley()};
  add_points(scene, {{2, 2, 0.5f}, {2, 0.5f, 0.5f}, {0.5f, 3, 0.5f}, {3.5f, 3, 0.5f}, {2, 1, 0.5f}, {1, 4, 0.5f}});
  const Overlaps overlaps = overlaps_of(scene);
  for (Index k = 0; k < 6; ++k) EXPECT_EQ(vertex_is_inside(overlaps, 10 + k), k >= 1 && k <= 3) << k;
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
  for (const Penetration& in : overlaps.penetrations) {
    const glm::dvec3 p(scene.at(in.vertex));
    double nearest_sample = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : mesh.triangles) {
      constexpr int steps = 12;
      for (int i = 0; i <= steps; ++i) {
        for (int j = 0; i + j <= steps; ++j) {
          const glm::dvec3 q = (glm::dvec3(mesh.vertices[a]) * double(i) + glm::dvec3(mesh.vertices[b]) * double(j) +
                                glm::dvec3(mesh.vertices[c]) * double(steps - i - j)) /
                               double(steps);
          nearest_sample = std::min(nearest_sample, glm::length(q - p));
        }
      }
    }
    EXPECT_LE(in.depth, nearest_sample + 1e-12);
    EXPECT_GT(in.depth, nearest_sample - 0.05);
    EXPECT_NEAR(glm::length(in.point - p), in.depth, 1e-12);
    EXPECT_NEAR(glm::length(in.normal), 1, 1e-12);
  }
}

TEST(FindOverlaps, NamesTheFirstOfEquallyNearFaces) {
  Scene scene{box(glm::vec3(0), glm::vec3(4))};
  add_points(scene, {glm::vec3(2), {2, 3, 2}});  // in the centre, and below the diagonal of a side
  const Overlaps overlaps = overlaps_of(scene);
  ASSERT_EQ(overlaps.penetrations.size(), 2u);
  EXPECT_EQ(overlaps.penetrations[0].triangle, 0u);
  const std::vector<Triangle>& faces = scene.surfaces[0]->triangles();
  const auto first_above = std::find_if(faces.begin(), faces.end(), [&](const Triangle& t) {
    return std::all_of(t.begin(), t.end(), [&](Index v) { return scene.at(v).y == 4; });
  });
  EXPECT_EQ(overlaps.penetrations[1].triangle, static_cast<Index>(first_above - faces.begin()));
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
  const Overlaps overlaps = overlaps_of(Scene{cloth});  // the last row is pulled below the second row
  const Overlaps above = overlaps_of([&] {
    SurfaceMesh other = cloth;
    for (Index k = 20; k < 25; ++k) other.vertices[k].y = 0.5f;
    return Scene{other};
  }());
  EXPECT_TRUE(overlaps.piercings.empty() && above.piercings.empty());
  for (Index k = 15; k < 20; ++k) cloth.vertices[k] = {cloth.vertices[k].x, 0.5f, -1.2f};
  const Scene through{cloth};
  const SurfaceFigures figures = figures_of(through);
  EXPECT_GT(figures.piercings, 3u);
  EXPECT_EQ(figures.self_intersecting_bodies, 1u);
  EXPECT_EQ(figures.overlapping_pairs, 0u);
}

// Touching is not penetrating.

TEST(FindOverlaps, StackedBoxesDoNotOverlap) {
  const SurfaceMesh below = box(glm::vec3(0), glm::vec3(4));
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

TEST(FindOverlaps, CoincidentBodiesDoNotOverlap) {
  EXPECT_EQ(figures_of(Scene{ball(1), ball(1)}), SurfaceFigures{});
  Scene scene{ball(1)};
  add_points(scene, std::vector<glm::vec3>(3, glm::vec3(0.1f)));  // coincident vertices
  EXPECT_EQ(overlaps_of(scene).penetrations.size(), 3u);
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
