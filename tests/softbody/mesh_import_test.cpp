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
  const std::string line = test::error_of<MeshFileError>([&] { read(obj, file); });
  EXPECT_TRUE(line == "was taken" || line.find("a.obj") != std::string::npos) << line;
  return line;
}

const std::string cube_vertices =
    "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 0 2\nv 2 0 2\nv 2 2 2\nv 0 2 2\n";  // 1-4 at z = 0, 5-8 above
const std::string cube_faces = "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

const std::array<std::array<int, 4>, 6> sides_of_cube{
    {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}}};  // bit k: coordinate k is 1

/// Each side with vertices of its own, as exporters write meshes with a normal a face. apart: m, between copies of a
/// corner.
std::string sides_apart(double apart, const glm::dvec3& at = glm::dvec3(0.0)) {
  std::string text;
  int number = 0;
  for (const auto& corners : sides_of_cube) {
    for (const int corner : corners)
      text += vertex(at + glm::dvec3((corner & 1) + apart * (++number % 3), corner >> 1 & 1, corner >> 2 & 1));
    text += face({-4, -3, -2, -1});
  }
  return text;
}

TEST(MeshImport, MakesAClosedMeshOfACubeOfQuads) {
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

TEST(MeshImport, WeldsWithinADistanceRelativeToTheSize) {
  EXPECT_FALSE(read(sides_apart(0.005)).mesh.closed) << "5 to 10 mm apart, in 1 m";
  EXPECT_TRUE(read(sides_apart(0.005), {.weld = 0.011}).mesh.closed);
  EXPECT_TRUE(read(sides_apart(0.005), {.size = 50, .weld = 0.011}).mesh.closed) << "however large it becomes";
  EXPECT_EQ(read(sides_apart(0), {.weld = 0}).mesh.vertices.size(), 8u) << "0 welds what is equal";
}

TEST(MeshImport, RefusesMeshesThatAreTooSmallOrTooLarge) {
  const auto corner = [](double side) {
    return vertex({0, 0, 0}) + vertex({side, 0, 0}) + vertex({0, side, 0}) + vertex({0, 0, side}) +
           "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  };
  EXPECT_NEAR(read(corner(1.00002 * min_body_size)).findings.extent, min_body_size, 1e-7);
  EXPECT_NEAR(read(corner(0.99998 * max_body_size)).findings.extent, max_body_size, 1);
  EXPECT_THROW(read(corner(0.0008)), MeshFileError);
  EXPECT_THROW(read(corner(12e3)), MeshFileError);
  EXPECT_NEAR(read(corner(0.0008), {.size = 1}).findings.extent, 1, 1e-12);
}

TEST(MeshImport, WeldsNearVerticesInEveryDirection) {
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

TEST(MeshImport, DropsTurnsAndWeldsAndSaysSo) {
  const std::string plain = cube_vertices + cube_faces, corners = tetrahedron.substr(0, tetrahedron.find('f')),
                    sides = "f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n",
                    sides_inwards = "f 5 6 2 1\nf 6 7 3 2\nf 7 8 4 3\nf 8 5 1 4\n";
  const struct {
    std::string obj;
    double volume;  // m^3; of an open mesh, that of its faces and its middle
    const char* remarks;
  } rows[]{
      {plain, 8, ""},
      {sides_apart(0), 1, "16 vertices welded"},
      {corners + "f 1 2 3\nf 1 4 2\nf 2 4 3\nf 1 3 4\n", 1.0 / 6, "4 faces turned"},
      {corners + "f 1 3 2\nf 1 4 2\nf 2 3 4\nf 1 4 3\n", 1.0 / 6, "1 faces turned"},
      {tetrahedron + "o second\nv 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\nf 5 6 7\nf 5 8 6\nf 6 8 7\nf 5 7 8\n", 2.0 / 6,
       "4 faces turned, 2 separate pieces, one body"},
      {cube_vertices + "f 4 3 2 1\n" + sides, 20.0 / 3, "open, so that it holds no gas"},
      {cube_vertices + "f 1 2 3 4\n" + sides_inwards, -20.0 / 3, "open, so that it holds no gas"},
      {"v 1000 0 0\nv -1e30 0 0\no t\n" + corners + "f 3 5 4\nf 3 4 6\nf 4 5 6\nf 3 6 5\nf 3 3 4\nf 3 4 4 3\n", 1.0 / 6,
       "2 unused vertices dropped, 2 degenerate faces dropped"},
      {"v 2 0 0 2\n" + corners + "f 2 4 3\nf 2 3 5\nf 3 4 5\nf 2 5 4\n", 1.0 / 6,
       "1 unused vertices dropped, 1 weights of vertices passed over"},
      {plain + "f 4 3 2 1\n", 8, "1 duplicate faces dropped"},
      {plain + "f 2 1 4 3\n", 8, "1 duplicate faces dropped"},
      {plain + "f 1 2 3 4\n", 8, "1 duplicate faces dropped"},
      {plain + "f 3 4 1 2\n", 8, "1 duplicate faces dropped"},
      {plain + cube_vertices + "f -5 -6 -7 -8\nf -4 -3 -2 -1\nf 9 10 14 13\nf 10 11 15 14\nf 11 12 16 15\n", 8,
       "8 vertices welded, 5 duplicate faces dropped"},
      {"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\nf 3 2 1\nf 4 3 1\n", 0,
       "2 duplicate faces dropped, open, so that it holds no gas"},
  };
  for (const auto& row : rows) {
    SCOPED_TRACE(row.obj);
    const auto [mesh, found] = read(row.obj);
    EXPECT_EQ(remarks(found), row.remarks);
    EXPECT_NEAR(volume(mesh.vertices, mesh.triangles), row.volume, 1e-12);
    EXPECT_EQ(mesh.closed, std::string(row.remarks).find("open") == std::string::npos);
    EXPECT_EQ(found.closed, mesh.closed);
    EXPECT_LE(found.extent, 6) << "unused vertices do not count";
  }
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

TEST(MeshImport, CutsOutlinesThatMeetThemselves) {
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

std::string cube_of_sides(int x, int y, int z) { return sides_apart(0, {x, y, z}); }

/// Seams only around the lid and along one edge, as if folded from paper.
std::string folded_cube(int x, int y, int z) {
  std::string text;
  for (const int corner : {0, 2, 1, 3, 5, 7, 4, 6, 0, 2, 5, 4, 7, 6})
    text += vertex({x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2 & 1)});
  for (int side = 0; side < 4; ++side) text += face({2 * side - 14, 2 * side - 12, 2 * side - 11, 2 * side - 13});
  return text + face({-12, -14, -3, -4}) + face({-13, -11, -2, -1});
}

TEST(MeshImport, KeepsClosedPartsThatTouchApart) {
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

TEST(MeshImport, KeepsAClosedObjectApartFromAnOpenOneThatTouchesIt) {
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

TEST(MeshImport, JoinsPartsThatCloseOneAnother) {
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

TEST(MeshImport, KeepsOpenPartsApartWhereAnEdgeWouldHaveThreeFaces) {
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

TEST(MeshImport, AdvisesALowerWeldWhereItCanHelp) {
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

TEST(MeshImport, ReadsPlyAsItReadsObj) {
  const Mesh cube = read(cube_vertices + cube_faces).mesh;
  for (const bool big_endian : {false, true}) {
    const Mesh ply = read(binary_ply<float>(cube, glm::dvec3(0.0), big_endian)).mesh;
    EXPECT_EQ(ply.vertices, cube.vertices);
    EXPECT_EQ(ply.triangles, cube.triangles);
  }
  Mesh fan;
  fan.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}};
  fan.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\nelement face 3\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 -1 0\n3 0 1 2\n3 0 1 3\n3 0 1 "
      "4\n";
  for (const auto& [ply, faces] :
       {std::pair(text, "lines 15, 16 and 17;"),
        {binary_ply<float>(fan, glm::dvec3(0.0), false), "faces 0, 1 and 2 (counted from 0);"}})
    EXPECT_NE(error_of(ply).find("between vertices 0 and 1 (counted from 0) has more than two faces: see " +
                                 std::string(faces)),
              std::string::npos)
        << error_of(ply);
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

TEST(MeshImport, KeepsTheFormOfAMeshFarFromTheOrigin) {
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

std::string ball(double radius, const glm::dvec3& at, bool inwards) {
  return obj_of(icosphere(1, radius), at, 6, inwards);
}
double ball_volume(double radius) {
  const Mesh mesh = icosphere(1, radius);
  return volume(mesh.vertices, mesh.triangles);
}

TEST(MeshImport, KeepsPartsThatFaceInwardsInsideOthersAsCavities) {
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

TEST(MeshImport, TurnsTheFewerFacesOfACavity) {
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

TEST(MeshImport, KeepsCavitiesInTheCoarseMesh) {
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

TEST(MeshImport, NamesTheFilesLinesAndVerticesInRefusals) {
  const std::string blade = "v 0 0 0\nv 1 0 0\nv 0 ";
  std::string band, corners, polygon = "f";
  for (int i = 0; i < 5; ++i) {
    const glm::dvec3 out(std::cos(1.2566 * i), 0, std::sin(1.2566 * i));
    band += vertex(out) + vertex(2.0 * out + glm::dvec3(0, 1, 0));
  }
  for (int i = 1; i < 8; i += 2) band += face({i, i + 1, i + 3, i + 2});
  for (int i = 0; i <= 1000; ++i) {
    corners += vertex({i, 1e-3 * i * i, 0});
    polygon.append(" ").append(std::to_string(i + 1));
  }
  const std::pair<std::string, const char*> rows[]{
      {cube_vertices + cube_faces + "f 1 2 7\n",
       "a.obj: the edge between vertices 1 and 2 (counted from 1) has more than two faces: see lines 9, 11 and 15; "
       "delete all but two of these faces, or give parts that touch there vertices of their own"},
      {blade + "1 0\nf 1 2 3\n" + blade + "0 1\nf -3 -2 -1\n" + blade + "-1 0\nf 7 8 9\n",
       "between vertices 1 and 2 (counted from 1) has more than two faces: see lines 4, 8 and 12;"},
      {"v 0 0 0\nv 1 .3 0\nv 1 0 1\nv 0 .3 1\nv 2 2 2\nf 1 3 5\nf 1 2 3 4\nf 2 4 5\n",
       "a.obj:7: a face that cannot be cut into triangles: "},
      {"v 0 0 0\nv 1 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nf 4 1 3 2\nf 1 3 5\nf 1 3 6\n",
       "between vertices 1 and 3 (counted from 1) has more than two faces: see lines 7, 8 and 9;"},
      {band + "f 9 10 1 2\n", "a.obj: the surface has only one side: see lines 13 and 14; "},
      {band + "f 9 10 2 1\n", "was taken"},  // without the twist
      {"v 0 0 0\nv 1 0 0\nl 1 2\n", "has no face"},
      {"", "no vertex"},
      {"v 0 0 0\nv nan 0 0\n", "a.obj:2: 'nan' is not finite"},
      {tetrahedron + "f 1 2 5\n", "a.obj:9: "},
      {tetrahedron.substr(0, 38), "a.obj:5: "},  // cut off
      {"v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n", "in one point"},
      {"v 0 0 0\nv 1e-200 0 0\nv 0 1e-200 0\nf 1 2 3\n", "in one point"},
      {"v 0 0 0\nv 1e9 0 0\nv 0 1 0\nf 1 2 3\n", "set size"},
      {"v 0 0 0\nv 1e39 0 0\nv 0 1e39 0\nf 1 2 3\n", "beyond 3.4e38"},
      {"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\nf 2 1 4\nf 4 1 3\n", "holds no volume"},
      {corners + polygon + "\n", "1001 corners; at most 1000"},
  };
  for (const auto& [obj, says] : rows) {
    const std::string message = error_of(obj);
    EXPECT_NE(message.find(says), std::string::npos) << '"' << says << "\" is not in: " << message;
  }
  EXPECT_EQ(error_of("v 3e38 0 0\nv -3e38 0 0\nv 0 3e38 0\nf 1 2 3\n", {.size = 1}), "was taken");
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
  expect_error<MeshFileError>("large.obj: is larger than 256 MiB", [&] { import_mesh({.path = file}); });
}

}  // namespace THIS_FILE
}  // namespace softbody::test
