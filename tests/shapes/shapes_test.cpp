// The generator of the shapes in assets/meshes: its meshes are even and lie on the surfaces that it is told.

#include "tests/shapes/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include <glm/geometric.hpp>

#include "softbody/mesh/file_mesh.h"
#include "softbody/mesh/mesh_import.h"
#include "tests/shapes/mesher.h"

namespace shapes {
namespace {

using glm::dvec3;

/// Returns the smallest angle of a triangle, in degrees.
double smallest_angle(const softbody::Mesh& mesh) {
  double largest_cosine = -1;
  for (const auto& [i, j, k] : mesh.triangles)
    for (const auto& [a, b, c] : {std::array{i, j, k}, std::array{j, k, i}, std::array{k, i, j}})
      largest_cosine = std::max(largest_cosine, glm::dot(glm::normalize(mesh.vertices[b] - mesh.vertices[a]),
                                                         glm::normalize(mesh.vertices[c] - mesh.vertices[a])));
  return std::acos(largest_cosine) * 180 / std::numbers::pi;
}

TEST(RoundCone, IsTheUnionOfTheBallsAlongIt) {
  const dvec3 a(0.1, -0.2, 0.3), b(-0.4, 0.5, 0.1);
  const Distance cone = round_cone(a, 0.3, b, 0.1);
  for (int i = 0; i < 200; ++i) {
    const dvec3 p(std::sin(7.1 * i), std::sin(3.3 * i), std::cos(5.7 * i));
    double least = INFINITY;
    for (int s = 0; s <= 2000; ++s)
      least = std::min(least, glm::distance(p, glm::mix(a, b, s / 2000.0)) - std::lerp(0.3, 0.1, s / 2000.0));
    EXPECT_NEAR(std::max(cone(p), 0.0), std::max(least, 0.0), 1e-4);
  }
}

TEST(MakeMesh, IsEvenClosedAndOnTheSurface) {
  const Distance shape = smooth_union(
      {ellipsoid({0, 0.1, 0}, {0.3, 0.5, 0.2}, {1, 1, 0}), round_cone({0, 0, 0}, 0.2, {0.6, 0, 0}, 0.1)}, 0.1);
  softbody::Mesh mesh = make_mesh(shape, 1000);
  EXPECT_NEAR(double(mesh.vertices.size()), 1000, 50);
  for (const dvec3& v : mesh.vertices) EXPECT_NEAR(shape(v), 0, 1e-9);
  softbody::connect_triangles(mesh);
  EXPECT_TRUE(mesh.closed);
  EXPECT_GT(softbody::volume(mesh.vertices, mesh.triangles), 0);
  EXPECT_EQ(mesh.vertices.size() + mesh.triangles.size(), mesh.edges.size() + 2);
  EXPECT_GT(smallest_angle(mesh), 28);
}

TEST(Shapes, AreInTheFilesOfTheAssets) {
  for (const Shape& shape : shapes) {
    SCOPED_TRACE(shape.name);
    const auto path = std::filesystem::path(SBCOLLIDE_MESHES) / (std::string(shape.name) + ".ply");
    const softbody::FileMesh file = softbody::read_file_mesh(path);
    const Distance distance = shape.make();
    for (std::size_t v = 0; v < file.x.size(); ++v) ASSERT_NEAR(distance({file.x[v], file.y[v], file.z[v]}), 0, 1e-6);
    const softbody::ImportedMesh imported = softbody::import_mesh({.path = path});
    const softbody::ImportFindings& f = imported.findings;
    EXPECT_TRUE(f.closed);
    EXPECT_EQ(f.components, 1u);
    EXPECT_EQ(f.welded_vertices + f.unused_vertices + f.degenerate_faces + f.duplicate_faces + f.turned_faces, 0u);
    ASSERT_TRUE(imported.coarse) << "it rides on a coarse mesh";
    EXPECT_LT(imported.coarse->distance, 0.02 * f.extent);
    EXPECT_EQ(imported.coarse->crossings, 0u);
    EXPECT_NEAR(double(file.x.size()), shape.vertices, 0.05 * shape.vertices);
    EXPECT_GT(smallest_angle(imported.mesh), 28);
  }
}

}  // namespace
}  // namespace shapes
