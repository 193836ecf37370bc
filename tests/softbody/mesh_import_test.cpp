// Meshes from OBJ files: what is welded, dropped, turned, refused.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <sstream>

#include "softbody/limits.h"
#include "softbody/obj_file.h"
#include "tests/softbody/helpers.h"
#include "tests/softbody/obj_lines.h"

namespace softbody::test {
namespace {

ImportedMesh read(const std::string& obj, MeshFile file = {}) {
  const TemporaryFolder folder;
  file.path = folder.write("a.obj", obj);
  return import_mesh(file);
}

std::string error_of(const std::string& obj, const MeshFile& file = {}) {
  try {
    read(obj, file);
  } catch (const ObjError& e) {
    const std::string line = e.what();
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    EXPECT_NE(line.find("a.obj"), std::string::npos) << line;
    return line;
  }
  return "was taken";
}

const std::string cube_vertices =
    "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 0 2\nv 2 0 2\nv 2 2 2\nv 0 2 2\n";  // 1-4 at z = 0, 5-8 above
const std::string cube_faces = "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

/// Each face with corners of its own, as exporters write meshes with a normal a face; `apart`: between copies of a
/// corner.
std::string seamed_cube(double apart) {
  std::string text;
  int number = 0;
  for (const std::array<int, 4>& corners :
       {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}}) {
    for (const int corner : corners)
      text += vertex({2 * (corner & 1) + apart * (++number % 3), corner & 2, corner >> 1 & 2});
    text += face({-4, -3, -2, -1});
  }
  return text;
}

TEST(MeshImport, ACubeOfQuadsIsClosedAndTurnedOutwards) {
  const auto [mesh, found] = read(cube_vertices + cube_faces);
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_EQ(mesh.edges.size(), 18u);
  EXPECT_TRUE(mesh.closed && mesh.shear_pairs.empty());
  EXPECT_NEAR(volume(mesh.vertices, mesh.triangles), 8, 1e-12);
  EXPECT_EQ(found,
            (ImportFindings{
                .file_vertices = 8, .file_faces = 6, .components = 1, .closed = true, .file_extent = 2, .extent = 2}));
  EXPECT_EQ(remarks(found), "");
  for (const glm::dvec3& v : mesh.vertices) EXPECT_EQ(glm::abs(v), glm::dvec3(1)) << "its middle is the origin";
}

TEST(MeshImport, SeamsAreWelded) {
  const auto [mesh, found] = read(seamed_cube(0));
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_EQ(found.welded_vertices, 16u);
  EXPECT_TRUE(found.closed);
  EXPECT_NEAR(volume(mesh.vertices, mesh.triangles), 8, 1e-12);
  EXPECT_EQ(remarks(found), "16 vertices welded");
}

TEST(MeshImport, WeldIsADistanceRelativeToTheSize) {
  EXPECT_FALSE(read(seamed_cube(0.01)).mesh.closed) << "0.01 to 0.02 apart, in 2";
  EXPECT_TRUE(read(seamed_cube(0.01), {.weld = 0.011}).mesh.closed);
  EXPECT_TRUE(read(seamed_cube(0.01), {.size = 50, .weld = 0.011}).mesh.closed) << "however large it becomes";
  EXPECT_EQ(read(seamed_cube(0), {.weld = 0}).mesh.vertices.size(), 8u) << "0 welds what is equal";
}

TEST(MeshImport, WhatIsTooSmallOrTooLargeIsRefused) {
  const auto cube = [](double half) {
    std::string text;
    for (int corner = 0; corner < 8; ++corner)
      text += vertex(half * glm::dvec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1));
    return text + face({1, 3, 4, 2}) + face({5, 6, 8, 7}) + face({1, 2, 6, 5}) + face({2, 4, 8, 6}) +
           face({4, 3, 7, 8}) + face({3, 1, 5, 7});
  };
  EXPECT_NEAR(read(cube(0.50001 * least_body_size)).findings.extent, least_body_size, 1e-7);
  EXPECT_NEAR(read(cube(0.49999 * most_body_size)).findings.extent, most_body_size, 1);
  EXPECT_THROW(read(cube(0.0004)), ObjError);
  EXPECT_THROW(read(cube(6e3)), ObjError);
  EXPECT_NEAR(read(cube(0.0004), {.size = 1}).findings.extent, 1, 1e-12);
}

TEST(MeshImport, WhatIsNearIsWeldedInWhicheverDirectionItLies) {
  std::mt19937 random(5);
  std::string obj;
  constexpr int pairs = 100;
  for (int i = 0; i < pairs; ++i) {  // two faces, each with two corners of its own
    const glm::dvec3 first = random_vector(random, 5), way = random_vector(random, 1);
    for (const glm::dvec3& corner : {first, first + 0.009 * glm::normalize(way)})
      obj += vertex(corner) + vertex(random_vector(random, 5)) + vertex(random_vector(random, 5));
    obj += face({6 * i + 1, 6 * i + 2, 6 * i + 3}) + face({6 * i + 4, 6 * i + 5, 6 * i + 6});
  }
  EXPECT_EQ(read(obj, {.weld = 0.001}).findings.welded_vertices, std::size_t(pairs));
}

TEST(MeshImport, FacesAreTurnedOutwards) {
  const auto inverted = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 1 3 4\n");
  EXPECT_EQ(inverted.findings.turned_faces, 4u);
  EXPECT_NEAR(volume(inverted.mesh.vertices, inverted.mesh.triangles), 1.0 / 6, 1e-12);
  const auto mixed = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 4 2\nf 2 3 4\nf 1 4 3\n");
  EXPECT_EQ(mixed.findings.turned_faces, 1u);
  EXPECT_NEAR(volume(mixed.mesh.vertices, mixed.mesh.triangles), 1.0 / 6, 1e-12);
}

TEST(MeshImport, SeveralPiecesAreOneBody) {
  const auto [mesh, found] =
      read(tetrahedron + "o second\nv 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\nf 5 6 7\nf 5 8 6\nf 6 8 7\nf 5 7 8\n");
  EXPECT_EQ(found.components, 2u);
  EXPECT_EQ(found.turned_faces, 4u) << "each piece by itself";
  EXPECT_TRUE(mesh.closed);
  EXPECT_NEAR(volume(mesh.vertices, mesh.triangles), 2.0 / 6, 1e-12);
  EXPECT_EQ(remarks(found), "4 faces turned, 2 separate pieces, one body");
}

TEST(MeshImport, OpenMeshesStayOpenAndKeepTheirSide) {
  const std::string outwards = "f 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n",
                    inwards = "f 1 2 3 4\nf 5 6 2 1\nf 6 7 3 2\nf 7 8 4 3\nf 8 5 1 4\n";
  for (const std::string& faces : {outwards, inwards}) {
    const auto [mesh, found] = read(cube_vertices + faces);
    EXPECT_FALSE(mesh.closed || found.closed);
    EXPECT_EQ(mesh.triangles.size(), 10u);
    EXPECT_EQ(volume(mesh.vertices, mesh.triangles) < 0, faces == inwards);
    EXPECT_EQ(remarks(found), "open, so that it holds no gas");
  }
}

TEST(MeshImport, WhatNoFaceUsesIsDroppedAndDoesNotCount) {
  const auto [mesh, found] =
      read("v 1000 0 0\nv -1e30 0 0\n" + std::string("o t\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n") +
           "f 3 5 4\nf 3 4 6\nf 4 5 6\nf 3 6 5\nf 3 3 4\nf 3 4 4 3\n");
  EXPECT_EQ(mesh.vertices.size(), 4u);
  EXPECT_EQ(found.unused_vertices, 2u);
  EXPECT_EQ(found.degenerate_faces, 2u);
  EXPECT_EQ(found.extent, 1) << "unused vertices do not make it larger";
  EXPECT_TRUE(mesh.closed);
}

TEST(MeshImport, OfDuplicateFacesTheFirstStays) {
  for (const char* again : {"f 4 3 2 1\n", "f 2 1 4 3\n", "f 1 2 3 4\n", "f 3 4 1 2\n"}) {
    const auto [mesh, found] = read(cube_vertices + cube_faces + again);
    EXPECT_EQ(mesh.triangles.size(), 12u) << again;
    EXPECT_TRUE(mesh.closed) << again;
    EXPECT_EQ(found.turned_faces, 0u) << again;
    EXPECT_EQ(remarks(found), "1 duplicate faces dropped") << again;
  }
  const auto [twice, found_twice] = read(cube_vertices + cube_faces + cube_vertices +
                                         "f -5 -6 -7 -8\nf -4 -3 -2 -1\nf 9 10 14 13\nf 10 11 15 14\nf 11 12 16 15\n");
  EXPECT_TRUE(twice.closed) << "the same at the same place, with vertices of its own";
  EXPECT_EQ(remarks(found_twice), "8 vertices welded, 5 duplicate faces dropped");
  const auto [sheet, both_sides] = read("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\nf 3 2 1\nf 4 3 1\n");
  EXPECT_EQ(remarks(both_sides), "2 duplicate faces dropped, open, so that it holds no gas");
}

TEST(MeshImport, WeightsArePassedOverWithANote) {
  const auto [mesh, found] = read(
      "v 2 0 0 2\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
      "f 2 4 3\nf 2 3 5\nf 3 4 5\nf 2 5 4\n");
  EXPECT_EQ(remarks(found), "1 unused vertices dropped, 1 weights of vertices passed over");
}

TEST(MeshImport, SizeAndUpPlaceIt) {
  const auto [mesh, found] = read(cube_vertices + cube_faces, {.size = 0.5});
  EXPECT_NEAR(volume(mesh.vertices, mesh.triangles), 0.125, 1e-12);
  EXPECT_EQ(found.file_extent, 2);
  EXPECT_NEAR(found.extent, 0.5, 1e-12);
  for (const glm::dvec3& up : {glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(0, -2, 0), glm::dvec3(0, 1, 0)}) {
    // A needle of a tetrahedron whose tip points up.
    std::string text;
    const glm::dvec3 n = glm::normalize(up), side(n.y, n.z, n.x), other = glm::cross(n, side);
    for (const glm::dvec3& p : {side, other, -side - other, 9.0 * n}) text += vertex(p);
    const Mesh needle = read(text + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n", {.up = up}).mesh;
    EXPECT_GT(volume(needle.vertices, needle.triangles), 1) << "turned, not mirrored";
    std::vector<double> heights;
    for (const glm::dvec3& v : needle.vertices) heights.push_back(v.y);
    std::sort(heights.begin(), heights.end());
    EXPECT_NEAR(heights[2], -4.5, 1e-5) << "the other three lie below";
    EXPECT_NEAR(heights[3], 4.5, 1e-5);
  }
}

TEST(MeshImport, RefusesWithTheReason) {
  EXPECT_NE(error_of("v 0 0 0\nv 1 0 0\nl 1 2\n").find("has no face"), std::string::npos);
  EXPECT_NE(error_of("").find("no vertex"), std::string::npos);
  EXPECT_NE(error_of("v 0 0 0\nv nan 0 0\n").find("a.obj:2: 'nan' is not finite"), std::string::npos);
  EXPECT_NE(error_of(tetrahedron + "f 1 2 5\n").find("a.obj:9: "), std::string::npos);
  EXPECT_NE(error_of(tetrahedron.substr(0, 38)).find("a.obj:5: "), std::string::npos) << "cut off";
  EXPECT_NE(error_of("v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n").find("in one point"), std::string::npos);
  EXPECT_NE(error_of("v 0 0 0\nv 1e9 0 0\nv 0 1 0\nf 1 2 3\n").find("set size"), std::string::npos);
  EXPECT_NE(
      error_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\nf 2 1 4\nf 4 1 3\n").find("holds no volume"),
      std::string::npos);
  EXPECT_NE(
      error_of(cube_vertices + cube_faces + "f 1 2 7\n").find("vertices 1 and 2 (counted from 1) has more than two"),
      std::string::npos);
  std::string strip;  // Moebius' band of five squares
  for (int i = 0; i < 5; ++i) {
    const glm::dvec3 out(std::cos(1.2566 * i), 0, std::sin(1.2566 * i));
    strip += vertex(out) + vertex(2.0 * out + glm::dvec3(0, 1, 0));
  }
  for (int i = 1; i < 8; i += 2) strip += face({i, i + 1, i + 3, i + 2});
  EXPECT_NE(error_of(strip + "f 9 10 1 2\n").find("only one side"), std::string::npos);
  EXPECT_EQ(error_of(strip + "f 9 10 2 1\n"), "was taken") << "without the twist";
  std::string polygon = "f";
  for (int i = 0; i <= 1000; ++i) {
    strip += vertex({i, 1e-3 * i * i, 0});
    polygon.append(" -").append(std::to_string(i + 1));
  }
  EXPECT_NE(error_of(strip + polygon + "\n").find("1001 corners; at most 1000"), std::string::npos);
}

/// A strip of triangles of `vertices` vertices.
std::string long_strip(int vertices) {
  std::string text;
  for (int i = 0; i < vertices; ++i) text += vertex({0.05 * i, i % 2, 0});
  for (int i = 3; i <= vertices; ++i) text += face({i - 2, i - 1, i});
  return text;
}

TEST(MeshImport, TakesAHundredThousandVerticesAndNoMore) {
  EXPECT_EQ(read(long_strip(100'000)).mesh.vertices.size(), 100'000u);
  EXPECT_NE(error_of(long_strip(100'001)).find("has 100001 vertices; at most 100000"), std::string::npos);
}

/// Nothing is read of it: it takes no place on the disk, and would be 256 MiB of zeros in memory.
TEST(MeshImport, RefusesALargerFileUnread) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.write("large.obj", tetrahedron);
  EXPECT_NO_THROW(import_mesh({.path = file}));
  std::filesystem::resize_file(file, max_mesh_file_size + 1);
  try {
    import_mesh({.path = file});
    FAIL() << "was taken";
  } catch (const ObjError& e) {
    EXPECT_NE(std::string(e.what()).find("large.obj: is larger than 256 MiB"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace softbody::test
