// Meshes from files: what is welded, dropped, turned, refused.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <iomanip>
#include <sstream>

#include "softbody/mesh/file_mesh.h"
#include "softbody/mesh/limits.h"
#include "tests/softbody/helpers.h"
#include "tests/softbody/obj_lines.h"

namespace softbody::test {
namespace THIS_FILE {

struct Read {
  Mesh mesh;
  ImportFindings findings;
};
Read read(const std::string& obj, MeshFile file = {}) {
  const TemporaryFolder folder;
  file.path = folder.write("a.obj", obj);
  ImportedMesh imported = import_mesh(file);
  return {std::move(imported.mesh), imported.findings};
}

std::string remarks(const ImportFindings& findings) { return softbody::remarks({.mesh = {}, .findings = findings}); }

std::string error_of(const std::string& obj, const MeshFile& file = {}) {
  try {
    read(obj, file);
  } catch (const MeshFileError& e) {
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

const std::array<std::array<int, 4>, 6> sides_of_cube{
    {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}}};  // bit k: coordinate k is 1

/// Each face with corners of its own, as exporters write meshes with a normal a face; `apart`: between copies of a
/// corner.
std::string seamed_cube(double apart) {
  std::string text;
  int number = 0;
  for (const auto& corners : sides_of_cube) {
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
  ImportFindings expected;
  expected.components = 1, expected.closed = true;
  expected.file_extent = expected.extent = 2;
  EXPECT_EQ(found, expected);
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
  EXPECT_NEAR(read(cube(0.50001 * min_body_size)).findings.extent, min_body_size, 1e-7);
  EXPECT_NEAR(read(cube(0.49999 * max_body_size)).findings.extent, max_body_size, 1);
  EXPECT_THROW(read(cube(0.0004)), MeshFileError);
  EXPECT_THROW(read(cube(6e3)), MeshFileError);
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

TEST(MeshImport, QuadsThatShareThreeVerticesAreCutApart) {
  const auto [mesh, found] = read("v 0 0 0\nv 1 -.2 .5\nv 0 0 1\nv 0 1.5 .5\nv -1 -.2 .5\nf 1 4 3 2\nf 1 5 3 4\n");
  EXPECT_EQ(mesh.triangles.size(), 4u);
  EXPECT_EQ(found.components, 1u);
}

TEST(MeshImport, AnOutlineThatMeetsItselfHoldsWhatItRunsAround) {
  const std::string corners = "v 0 0 0\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nv -1 0 1\n";
  EXPECT_EQ(read(corners + "f 1 2 3 1 4 5\n").mesh.triangles.size(), 2u) << "two triangles at a vertex";
  EXPECT_EQ(read(corners + "f 1 2 3 4 3\n").mesh.triangles.size(), 1u) << "a spike holds nothing";
  EXPECT_EQ(read(corners + "f 4 3 1 2 3\n").mesh.triangles.size(), 1u) << "at the end, too";
  EXPECT_EQ(
      error_of("v 9.3 8.7 5\nv 2.7 5.4 4.9\nv 6.1 5 .6\nv 6.6 1.1 9.2\nv 4.7 1.5 4.3\nv 6.2 4.3 4.2\nv 9.3 3.5 9.9\n"
               "f 1 2 3 1 4 5 6 7\n"),
      "was taken")
      << "no edge is cut twice";
  const auto [ring, found] =
      read("v 0 0 0\nv 4 0 0\nv 4 0 4\nv 0 0 4\nv 1 0 1\nv 1 0 3\nv 3 0 3\nv 3 0 1\nf 1 2 3 4 1 5 6 7 8 5\n");
  EXPECT_EQ(ring.triangles.size(), 8u) << "a hole is none of it";
}

std::string cube(int x, int y, int z) {
  std::string text;
  for (int corner = 0; corner < 8; ++corner)
    text += vertex({x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2 & 1)});
  for (const auto& corners : sides_of_cube)
    text += face({corners[0] - 8, corners[1] - 8, corners[2] - 8, corners[3] - 8});
  return text;
}

/// Each side with vertices of its own.
std::string cube_of_sides(int x, int y, int z) {
  std::string text;
  for (const auto& corners : sides_of_cube) {
    for (const int corner : corners) text += vertex({x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2 & 1)});
    text += face({-4, -3, -2, -1});
  }
  return text;
}

/// Seams only around the lid and along one edge, as if folded from paper.
std::string folded_cube(int x, int y, int z) {
  std::string text;
  for (const int corner : {0, 2, 1, 3, 5, 7, 4, 6, 0, 2, 5, 4, 7, 6})
    text += vertex({x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2 & 1)});
  for (int side = 0; side < 4; ++side) text += face({2 * side - 14, 2 * side - 12, 2 * side - 11, 2 * side - 13});
  return text + face({-12, -14, -3, -4}) + face({-13, -11, -2, -1});
}

TEST(MeshImport, ClosedPartsThatTouchStayApart) {
  for (const auto& part : {cube, cube_of_sides, folded_cube})
    for (const char* next : {"", "o next\n"})
      for (const glm::ivec3& at : {glm::ivec3(1, 0, 0), {1, 1, 0}, {0, -1, 0}, {0, 0, 0}, {-1, 1, 0}}) {
        const auto [mesh, found] = read(part(0, 0, 0) + next + part(at.x, at.y, at.z));
        EXPECT_TRUE(mesh.closed);
        const bool same = at == glm::ivec3(0);
        EXPECT_EQ(mesh.vertices.size(), same ? 8u : 16u);
        EXPECT_EQ(found.components, same ? 1u : 2u);
        EXPECT_EQ(found.duplicate_faces, same ? 6u : 0u) << "a copy is dropped";
      }
  std::string eight;
  for (int corner = 0; corner < 8; ++corner) eight += cube_of_sides(corner & 1, corner >> 1 & 1, corner >> 2);
  EXPECT_EQ(read(eight).findings.components, 8u);
  EXPECT_TRUE(read(eight).mesh.closed);
}

TEST(MeshImport, AnObjectIsClosedThatOneWithoutALidTouches) {
  std::string open_box = cube_of_sides(0, 0, 1);
  open_box.erase(0, open_box.find('f'));  // where the lower cube is
  open_box.erase(0, open_box.find('v'));
  for (const std::string& both : {"o cube\n" + cube_of_sides(0, 0, 0) + "o box\n" + open_box,
                                  "o box\n" + open_box + "o cube\n" + cube_of_sides(0, 0, 0)}) {
    const auto [mesh, found] = read(both);
    EXPECT_EQ(mesh.vertices.size(), 16u);
    EXPECT_EQ(found.components, 2u);
  }
}

TEST(MeshImport, PartsThatCloseOneAnotherAreJoined) {
  std::string halves;
  for (const int side : {1, -1}) {
    halves += "o half\n";
    for (int corner = 0; corner < 8; ++corner)
      halves += vertex({side * (corner & 1), corner >> 1 & 1, corner >> 2 & 1});
    for (const auto& corners : sides_of_cube)
      if (corners != sides_of_cube.back())  // at x = 0
        halves += face({corners[0] - 8, corners[1] - 8, corners[2] - 8, corners[3] - 8});
  }
  for (const std::string& other : {std::string(), cube(0, 1, 0), cube_of_sides(0, 1, 0)}) {
    const auto [mesh, found] = read(halves + other);
    EXPECT_TRUE(mesh.closed);
    EXPECT_EQ(found.components, other.empty() ? 1u : 2u) << "what touches the seam stays apart";
  }
}

TEST(MeshImport, OpenPartsThatTouchStayApartIfTheyMust) {
  const auto sleeve = [](int x) {
    std::string text;
    for (const int height : {0, 1})
      for (const int corner : {0, 1, 3, 2}) text += vertex({x + (corner & 1), height, corner >> 1});
    for (const int side : {0, 1, 2, 3}) text += face({side - 8, (side + 1) % 4 - 8, (side + 1) % 4 - 4, side - 4});
    return text;
  };
  EXPECT_EQ(read(sleeve(0) + sleeve(1)).findings.components, 2u);
  EXPECT_EQ(read("o a\n" + sleeve(0) + "o b\n" + sleeve(1)).mesh.vertices.size(), 16u);
  const std::string fin = vertex({0, 0, 0}) + vertex({1, 0, 0}) + vertex({1, -1, 0}) + vertex({0, -1, 0});
  for (const auto& part : {cube, cube_of_sides})
    EXPECT_EQ(read(part(0, 0, 0) + fin + "f -4 -3 -2 -1\n").findings.components, 2u);
}

TEST(MeshImport, RefusalsNameTheFilesOwnLinesAndVertices) {
  const auto says = [](const std::string& obj, const std::string& what) {
    EXPECT_NE(error_of(obj).find(what), std::string::npos) << error_of(obj);
  };
  says(cube_vertices + cube_faces + "f 1 2 7\n",
       "a.obj: the edge between vertices 1 and 2 (counted from 1) has more than two faces: see lines 9, 11 and 15; "
       "delete all but two of these faces, or give parts that touch there vertices of their own");
  const std::string blade = "v 0 0 0\nv 1 0 0\nv 0 ";
  says(blade + "1 0\nf 1 2 3\n" + blade + "0 1\nf -3 -2 -1\n" + blade + "-1 0\nf 7 8 9\n",
       "between vertices 1 and 2 (counted from 1) has more than two faces: see lines 4, 8 and 12;");
  says("v 0 0 0\nv 1 .3 0\nv 1 0 1\nv 0 .3 1\nv 2 2 2\nf 1 3 5\nf 1 2 3 4\nf 2 4 5\n",
       "a.obj:7: a face that cannot be cut into triangles: ");
  says("v 0 0 0\nv 1 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nf 4 1 3 2\nf 1 3 5\nf 1 3 6\n",
       "between vertices 1 and 3 (counted from 1) has more than two faces: see lines 7, 8 and 9;");
  std::string band;
  for (int i = 0; i < 5; ++i) {
    const double a = 1.2566 * i;
    band += vertex({std::cos(a), 0, std::sin(a)}) + vertex({2 * std::cos(a), 1, 2 * std::sin(a)});
  }
  says(band + "f 1 2 4 3\nf 3 4 6 5\nf 5 6 8 7\nf 7 8 10 9\nf 9 10 1 2\n",
       "a.obj: the surface has only one side: see lines 13 and 14; ");
}

TEST(MeshImport, RefusalsAdviseALowerWeldWhereItCanHelp) {
  const auto advises_it = [](const std::string& obj, double weld) {
    return error_of(obj, {.weld = weld}).find(", or lower weld (in the window under Files, ") != std::string::npos;
  };
  const auto fan = [](double gap) {  // three faces at an edge, each with vertices of its own
    std::string text;
    for (int i = 0; i < 3; ++i)
      text += vertex({0, 0, i * gap}) + vertex({1, 0, i * gap}) + vertex({0.5, i - 1, i}) + face({-3, -2, -1});
    return text;
  };
  EXPECT_TRUE(advises_it(fan(1e-4), 1e-3));
  EXPECT_EQ(read(fan(1e-4)).findings.components, 3u) << "it does help";
  EXPECT_FALSE(advises_it(fan(0), 1e-3)) << "the places are the same";
  const std::string seam = vertex({5, 5, 0}) + vertex({6, 5, 0}) + vertex({5, 6, 0}) + face({-3, -2, -1}) +
                           vertex({5, 5, 1e-4}) + vertex({6, 5, 1e-4}) + vertex({5, 4, 0}) + face({-2, -3, -1});
  EXPECT_FALSE(advises_it(cube_vertices + cube_faces + "f 1 2 7\n" + seam, 1e-3)) << "it joins other faces";

  const auto band = [](double gap) {  // of Moebius; its ends are `gap` apart
    std::string text;
    for (int i = 0; i < 6; ++i) {
      const double a = 1.2566 * i + (i == 5 ? gap : 0), low = i < 5 ? 1 : 2, high = 3 - low;
      text +=
          vertex({low * std::cos(a), low, low * std::sin(a)}) + vertex({high * std::cos(a), high, high * std::sin(a)});
    }
    for (int i = 0; i < 5; ++i) text += face({2 * i + 1, 2 * i + 2, 2 * i + 4, 2 * i + 3});
    return text;
  };
  EXPECT_TRUE(advises_it(band(1e-3), 1e-2));
  EXPECT_EQ(read(band(1e-3)).findings.components, 1u) << "it does help";
}

/// Returns the cube as a PLY file. more: a further face.
std::string cube_ply(const std::string& format, const std::vector<std::uint8_t>& more = {}) {
  std::vector<std::vector<std::uint8_t>> faces{{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                               {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  if (!more.empty()) faces.push_back(more);
  std::string text =
      "ply\nformat " + format + " 1.0\nelement vertex 8\nproperty uchar x\nproperty uchar y\nproperty uchar z\n";
  text += "element face " + std::to_string(faces.size()) + "\nproperty list uchar uchar vertex_indices\nend_header\n";
  const auto add = [&](std::size_t number) {
    text += format == "ascii" ? std::to_string(number) + " " : std::string(1, static_cast<char>(number));
  };
  const auto end_row = [&] { text += format == "ascii" ? "\n" : ""; };
  for (std::size_t v = 0; v < 8; ++v, end_row()) add((v + 1) % 4 / 2 * 2), add(v % 4 / 2 * 2), add(v / 4 * 2);
  for (const auto& face : faces) {
    add(face.size());
    for (const std::size_t corner : face) add(corner);
    end_row();
  }
  return text;
}

TEST(MeshImport, ReadsPlyAsItReadsObj) {
  const Mesh obj = read(cube_vertices + cube_faces).mesh;
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const Read ply = read(cube_ply(format));
    EXPECT_EQ(ply.mesh.vertices, obj.vertices) << format;
    EXPECT_EQ(ply.mesh.triangles, obj.triangles) << format;
    EXPECT_TRUE(ply.findings.closed);
  }
  EXPECT_NE(error_of(cube_ply("ascii", {0, 1, 6}))
                .find("between vertices 0 and 1 (counted from 0) has more than two faces: see lines 18, 20 and 24;"),
            std::string::npos)
      << error_of(cube_ply("ascii", {0, 1, 6}));
  EXPECT_NE(error_of(cube_ply("binary_little_endian", {0, 1, 6}))
                .find("between vertices 0 and 1 (counted from 0) has more than two faces: see faces 0, 2 and 6 "
                      "(counted from 0);"),
            std::string::npos);
}

/// Returns a mesh as a PLY file with coordinates of this type, moved by `at`.
template <class Real>
std::string binary_ply(const Mesh& mesh, const glm::dvec3& at, bool big_endian) {
  std::string text = std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
                     "_endian 1.0\nelement vertex " + std::to_string(mesh.vertices.size()) + '\n';
  for (const char* axis : {"x", "y", "z"})
    text += std::string("property ") + (sizeof(Real) == 8 ? "double " : "float ") + axis + '\n';
  text +=
      "element face " + std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_index\nend_header\n";
  const auto add = [&]<class Number>(Number number) {
    auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(number);
    if (big_endian != (std::endian::native == std::endian::big)) std::ranges::reverse(bytes);
    text.append(bytes.begin(), bytes.end());
  };
  for (const glm::dvec3& v : mesh.vertices)
    for (int axis = 0; axis < 3; ++axis) add(static_cast<Real>(at[axis] + v[axis]));
  for (const Triangle& t : mesh.triangles) {
    text += '\3';
    for (const Index corner : t) add(static_cast<std::int32_t>(corner));
  }
  return text;
}

/// Returns a mesh as an OBJ file with so many decimals, moved by `at`. turned: its faces are reversed.
std::string obj_of(const Mesh& mesh, const glm::dvec3& at, int decimals, bool turned = false) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(decimals);
  for (const glm::dvec3& v : mesh.vertices)
    text << "v " << at.x + v.x << ' ' << at.y + v.y << ' ' << at.z + v.z << '\n';
  const auto count = int(mesh.vertices.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const int i = int(a) - count, j = int(b) - count, k = int(c) - count;
    text << (turned ? face({i, k, j}) : face({i, j, k}));
  }
  return text.str();
}

constexpr glm::dvec3 on_a_map(448262.25, 112.5, 5411932.75), on_the_globe(4027893.7517, 307045.6003, 4919474.9114);

TEST(MeshImport, AMeshFarFromTheOriginKeepsItsForm) {
  const Mesh large = icosphere(3, 6), small = icosphere(3, 0.5);
  for (const std::string& file :
       {obj_of(large, on_a_map, 4), obj_of(large, on_a_map, 6), binary_ply<double>(large, on_a_map, false),
        binary_ply<double>(large, on_a_map, true), obj_of(small, on_the_globe, 6),
        binary_ply<double>(small, on_the_globe, false), binary_ply<double>(small, 1e4 * on_the_globe, false)})
    for (const glm::dvec3& up : {glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(1, 2, 3)}) {
      const auto [mesh, found] = read(file, {.size = 1, .up = up});
      ASSERT_EQ(mesh.vertices.size(), 642u) << "no vertex vanishes";
      const double widest = up == glm::dvec3(1, 2, 3) ? 0.002 : 0;  // a box of its corners, not of the round sphere
      for (const glm::dvec3& v : mesh.vertices) ASSERT_NEAR(glm::length(v), 0.5, 1e-5 + widest);
      EXPECT_EQ(found.coarse_step, 0);
      EXPECT_EQ(remarks(found), "");
    }
}

TEST(MeshImport, SaysWhereAFileHasTooFewDigits) {
  const Mesh ball = icosphere(3, 6);
  const auto remark = [&](const std::string& file) { return remarks(read(file, {.size = 1}).findings); };
  for (const std::string& file : {binary_ply<float>(ball, on_a_map, false), binary_ply<float>(ball, on_a_map, true)})
    EXPECT_EQ(remark(file),
              "the file gives coordinates in steps of 0.5, which is much of its edges: export it with more digits, or "
              "nearer to the origin");
  EXPECT_NE(remark(obj_of(ball, on_a_map, 0)).find("in steps of 1,"), std::string::npos);
  EXPECT_NE(remark(obj_of(ball, glm::dvec3(0), 0)).find("in steps of 1,"), std::string::npos) << "anywhere";
  EXPECT_EQ(remark(obj_of(ball, on_a_map, 2)), "");
  EXPECT_EQ(remark(binary_ply<float>(ball, {3e3, 0, 0}, false)), "");
  const std::string lost = error_of(binary_ply<float>(icosphere(3, 0.5), on_the_globe, false), {.size = 1});
  EXPECT_TRUE(lost == "was taken" || lost.find("in steps of 0.5, ") != std::string::npos) << lost;
  EXPECT_EQ(read(cube_vertices + cube_faces, {.size = 1}).findings.coarse_step, 0) << "whole numbers are meant so";
  EXPECT_EQ(read(obj_of(read(cube_vertices + cube_faces).mesh, on_a_map, 0)).findings.coarse_step, 0);
}

TEST(MeshImport, RefusesWhatFloatsCannotHold) {
  const std::string faces = "f 1 2 3\n";
  EXPECT_NE(error_of("v 0 0 0\nv 1e39 0 0\nv 0 1e39 0\n" + faces, {.size = 1}).find("beyond 3.4e38"),
            std::string::npos);
  EXPECT_NE(error_of("v 0 0 0\nv 1e-200 0 0\nv 0 1e-200 0\n" + faces, {.size = 1}).find("one point"),
            std::string::npos);
  EXPECT_EQ(error_of("v 3e38 0 0\nv -3e38 0 0\nv 0 3e38 0\n" + faces, {.size = 1}), "was taken");
}

std::string ball(double radius, const glm::dvec3& at, bool inwards) {
  return obj_of(icosphere(1, radius), at, 6, inwards);
}
double ball_volume(double radius) {
  const Mesh mesh = icosphere(1, radius);
  return volume(mesh.vertices, mesh.triangles);
}

TEST(MeshImport, APartInsideAnotherThatFacesInwardsIsACavity) {
  const glm::dvec3 here(0), off(0.2, 0.1, 0);
  const auto [mesh, found] = read(ball(1, here, false) + ball(0.6, off, true));
  EXPECT_TRUE(mesh.closed);
  EXPECT_NEAR(volume(mesh.vertices, mesh.triangles), ball_volume(1) - ball_volume(0.6), 1e-5);
  EXPECT_EQ(found.turned_faces, 0u);
  EXPECT_EQ(remarks(found), "1 cavity, which holds no gas");

  const auto expect = [](const std::string& obj, double wanted, std::size_t cavities, std::size_t turned) {
    const auto [m, f] = read(obj);
    EXPECT_NEAR(volume(m.vertices, m.triangles), wanted, 1e-5);
    EXPECT_EQ(f.cavities, cavities);
    EXPECT_EQ(f.turned_faces, turned);
  };
  const double one = ball_volume(1), large = ball_volume(0.6), small = ball_volume(0.2);
  expect(ball(0.6, off, true) + ball(1, here, false), one - large, 1, 0);   // in any order
  expect(ball(1, here, true) + ball(0.6, off, true), one - large, 1, 80);   // nothing is outside the first
  expect(ball(1, here, false) + ball(0.6, off, false), one + large, 0, 0);  // another body in it
  expect(ball(1, here, false) + ball(0.6, off, true) + ball(0.2, off, false), one - large + small, 1, 0);
  expect(ball(1, here, false) + ball(0.6, off, true) + ball(0.2, off, true), one - large + small, 1, 80);
  expect(ball(1, here, false) + ball(0.2, {0.5, 0, 0}, true) + ball(0.2, {-0.5, 0, 0}, true), one - 2 * small, 2, 0);
  expect(ball(1, here, false) + ball(0.6, {0.7, 0, 0}, true), one + large, 0, 80);  // sticks out
  expect(ball(1, here, false) + ball(0.6, {3, 0, 0}, true), one + large, 0, 80);    // lies beside it
  expect(ball(1, here, false) + ball(0.2, {0.5, 0, 0}, true) + ball(0.2, {0.6, 0, 0}, true), one + 2 * small, 0, 160);
  const std::string sleeve = vertex({0.5, 0, 0}) + vertex({2, 0, 0}) + vertex({2, 1, 0}) + face({-3, -2, -1});
  EXPECT_EQ(read(ball(1, here, false) + sleeve + ball(0.2, here, true)).findings.cavities, 1u)
      << "open parts do not count";
}

TEST(MeshImport, ACavityMayHaveSomeFacesTurned) {
  const std::string inner = ball(0.6, {0, 0, 0}, true);
  const std::size_t first = inner.find('f'), second = inner.find('f', first + 1);
  const Mesh sphere = icosphere(1, 0.6);
  const int n = int(sphere.vertices.size());
  const auto& [a, b, c] = sphere.triangles[0];
  const std::string mixed = inner.substr(0, first) + face({int(a) - n, int(b) - n, int(c) - n}) + inner.substr(second);
  const auto found = read(ball(1, {0, 0, 0}, false) + mixed).findings;
  EXPECT_EQ(found.cavities, 1u);
  EXPECT_EQ(found.turned_faces, 1u) << "most faces tell";
}

TEST(MeshImport, ACoarseMeshKeepsCavities) {
  const TemporaryFolder folder;
  const Mesh outer = icosphere(4, 1), inner = icosphere(3, 0.7);
  const auto file = folder.write("a.obj", obj_of(outer, {0, 0, 0}, 6) + obj_of(inner, {0, 0.1, 0}, 6, true));
  const ImportedMesh imported = import_mesh({.path = file, .resolution = 400});
  ASSERT_TRUE(imported.coarse);
  const double wanted = volume(imported.mesh.vertices, imported.mesh.triangles);
  EXPECT_NEAR(volume(imported.coarse->mesh.vertices, imported.coarse->mesh.triangles), wanted, 0.06 * wanted);
  EXPECT_NEAR(wanted, volume(outer.vertices, outer.triangles) - volume(inner.vertices, inner.triangles), 1e-4);
  EXPECT_EQ(imported.coarse->crossings, 0u);
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
  } catch (const MeshFileError& e) {
    EXPECT_NE(std::string(e.what()).find("large.obj: is larger than 256 MiB"), std::string::npos) << e.what();
  }
}

}  // namespace THIS_FILE
}  // namespace softbody::test
