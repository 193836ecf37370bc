// The reader of PLY files: formats, types and elements. Any bytes: tests/fuzz.

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/cli/ply_rig.h"
#include "tests/read_bodies.h"
#include "tests/temporary_folder.h"

namespace cli::test {
namespace THIS_FILE {

using app::files::BodyFile;
using app::files::BodyMeshes;
using Edges = std::vector<BodyMeshes::Edge>;

BodyFile read(const std::string& text) {
  const tests::TemporaryFolder folder;
  return app::files::read_bodies(folder.write("a.ply", text));
}

/// Returns the head of a text file with so many vertices and faces.
std::string head(std::size_t vertices, std::size_t faces) {
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertices) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(faces) +
         "\nproperty list uchar int vertex_index\nend_header\n";
}

TEST(ReadPly, ReadsAllFormatsAndTypes) {
  const std::vector<std::array<float, 3>> vertices{
      {0.1f, -0.0f, 3.4028235e38f}, {1e-40f, 2, 3}, {-1, 0x1p-149f, 7}, {8, 9, 10}, {11, 12, 13}};
  const std::vector<std::vector<unsigned>> faces{{4, 0, 1}, {0, 1, 2, 3}};
  for (const PlyForm& form : ply_forms()) {
    const BodyFile b = read(ply(vertices, faces, form));
    ASSERT_EQ(b.at.x.size(), vertices.size()) << text_of(form);
    for (std::size_t v = 0; v < vertices.size(); ++v)
      EXPECT_EQ((std::array{b.at.x[v], b.at.y[v], b.at.z[v]}), vertices[v]) << text_of(form);
    EXPECT_TRUE(std::signbit(b.at.y[0]));
    EXPECT_EQ(b.meshes.count(), 1u);
    EXPECT_EQ(b.meshes.edges(0), (Edges{{1, 4}, {4, 0}, {0, 1}, {3, 0}, {0, 1}, {1, 2}, {2, 3}})) << text_of(form);
  }
}

TEST(ReadPly, ReadsRowsOfAnyLayoutWithLineEndsOfAnySystem) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string text = head(3, 1) + "0 1 2\n\n 3 4\n5 \t\n6 7 8\n3 0\n1 2\n\n";
    for (std::size_t at = 0; (at = text.find('\n', at)) != text.npos; at += end.size()) text.replace(at, 1, end);
    const BodyFile b = read(text);
    EXPECT_EQ(b.at.y, (std::vector<float>{1, 4, 7}));
    EXPECT_EQ(b.meshes.edges(0), (Edges{{2, 0}, {0, 1}, {1, 2}}));
  }
}

/// Returns a binary file of one vertex (x, 2, 3), with another end for each line of its head.
std::string with_ends(const std::function<std::string(int line)>& end, float x) {
  std::string text = ply({{x, 2, 3}}, {}, {.format = "binary_little_endian"}), changed;
  const std::size_t rows = text.size() - 12;
  int line = 0;
  for (const char c : text.substr(0, rows)) changed += c == '\n' ? end(++line) : std::string(1, c);
  return changed + text.substr(rows);
}

TEST(ReadPly, DecidesByTheFirstLineWhereTheBinaryPartBegins) {
  // Bytes that look like ends of lines, of the file, or of a joined line.
  for (const unsigned first : {0x0au, 0x0du, 0x0d0au, 0x0a0du, 0x0a0au, 0x20u, 0x1au, 0x5cu, 0u})
    for (const std::string end : {"\n", "\r\n", "\r"}) {
      const float x = std::bit_cast<float>(0x3f800000u + first);
      EXPECT_EQ(read(with_ends([&](int) { return end; }, x)).at.x, std::vector<float>{x})
          << first << ' ' << int(end[0]);
    }
  const float x = std::bit_cast<float>(0x3f80000au);
  for (const std::string one : {"\n", "\r\n"})  // either is one end, whatever the others are
    EXPECT_EQ(read(with_ends([&](int line) { return line % 2 == 0 ? "\n" : one; }, x)).at.x, std::vector<float>{x});
}

/// Expects that the reader refuses a file with this message, or part of it.
void expect_error(const std::string& text, const std::string& message) {
  try {
    read(text);
    ADD_FAILURE() << "was taken: " << text;
  } catch (const app::files::MeshFileError& error) {
    EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
  }
}

TEST(ReadPly, RefusesAHeadWhoseLinesEndOtherwiseThanTheFirst) {
  for (const std::string first : {"\n", "\r\n", "\r"})
    for (const std::string other : {"\n", "\r\n", "\r"})
      for (const int odd : {2, 3, 7, 8}) {
        if ((first == "\r") == (other == "\r")) continue;
        const std::string text = with_ends([&](int line) { return line == odd ? other : first; }, 1);
        if (first == "\r" && other == "\r\n" && text.find("end_header\r\n") != text.npos) continue;  // LF is data
        expect_error(text, "end all lines of the header alike");
      }
  EXPECT_THROW(read("ply\nformat ascii 1.0\ncomment a\rproperty\n"), app::files::MeshFileError);
}

TEST(ReadPly, TakesAByteOrderMarkAndAnyNameOfTheFile) {
  const tests::TemporaryFolder folder;
  for (const char* format : {"ascii", "binary_little_endian"})
    for (const char* mark : {"", "\xEF\xBB\xBF"})
      for (const char* name : {"a.obj", "a.ply", "b.PLY"}) {
        const std::string text = mark + ply({{1, 2, 3}}, {}, {.format = format});
        EXPECT_EQ(app::files::read_bodies(folder.write(name, text)).at.x, std::vector<float>{1});
      }
  expect_error("\xFF\xFEp\0l\0y\0\n", "a.ply:1: is UTF-16; save it as UTF-8");
}

TEST(ReadPly, ReadsTriangleStrips) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n2 0 0\n3 0 0\n4 0 0\n5 0 0\n11 0 1 2 3 3 4 -1 3 4 5 -1\n";
  const BodyFile b = read(text);
  const std::vector<softbody::Index>& corners = b.meshes.polygons.corners;
  EXPECT_EQ(corners, (std::vector<softbody::Index>{0, 1, 2, 2, 1, 3, 3, 4, 5})) << "every other triangle is turned";
}

TEST(ReadPly, MakesConnectedPartsBodies) {
  const std::string points = "0 0 0\n1 0 0\n2 0 0\n3 0 0\n4 0 0\n5 0 0\n6 0 0\n7 0 0\n";
  const BodyFile b = read(head(8, 3) + points + "3 6 4 2\n3 5 3 7\n3 4 2 6\n");
  using Indices = std::vector<collide::Index>;
  EXPECT_EQ(b.meshes.first, (Indices{0, 3, 6, 8}));
  EXPECT_EQ(b.meshes.file_vertex, (Indices{2, 4, 6, 3, 5, 7, 0, 1})) << "by their first vertices; the rest last";
  EXPECT_EQ(b.at.x, (std::vector<float>{2, 4, 6, 3, 5, 7, 0, 1}));
  EXPECT_EQ(b.meshes.edges(0), (Edges{{0, 2}, {2, 1}, {1, 0}, {2, 1}, {1, 0}, {0, 2}}));
  EXPECT_EQ(b.meshes.edges(1), (Edges{{2, 1}, {1, 0}, {0, 2}}));
  EXPECT_TRUE(b.meshes.edges(2).empty());
  EXPECT_EQ(read(head(8, 0) + points).meshes.first, (Indices{0, 8}));
}

}  // namespace THIS_FILE
}  // namespace cli::test
