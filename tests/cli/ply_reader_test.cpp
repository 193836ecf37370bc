// The reader of PLY files: formats, types, elements, and random bytes.

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "tests/cli/detect_rig.h"
#include "tests/cli/ply_rig.h"
#include "tests/read_bodies.h"

namespace cli::test {
namespace THIS_FILE {

using app::files::BodyFile;
using app::files::BodyMeshes;
using Edges = std::vector<BodyMeshes::Edge>;

BodyFile read(const std::string& text) {
  const TemporaryFolder folder;
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

TEST(ReadPly, RoundsNumbersCorrectlyToFloats) {
  const BodyFile b = read(head(1, 0) + "1.000000059604644775390626 16777217.0000001 +1e-400\n");
  EXPECT_EQ(b.at.x[0], 1.00000011920928955f);
  EXPECT_EQ(b.at.y[0], 16777218.0f);
  EXPECT_EQ(b.at.z[0], 0.0f);
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

TEST(ReadPly, ReadsABinaryPartAfterAHeadWithAnyLineEnd) {
  const PlyForm form{.format = "binary_little_endian"};
  const std::string text = ply({{1, 2, 3}}, {}, form);
  const std::size_t rows = text.size() - 12;
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string changed = text.substr(0, rows);
    for (std::size_t at = 0; (at = changed.find('\n', at)) != changed.npos; at += end.size())
      changed.replace(at, 1, end);
    EXPECT_EQ(read(changed + text.substr(rows)).at.z, std::vector<float>{3});
  }
  // Bytes that look like ends of lines, of the file, or of a joined line.
  const float odd = std::bit_cast<float>(0x0a0d1a5c);
  EXPECT_EQ(read(ply({{odd, odd, odd}}, {}, form)).at.x, std::vector<float>{odd});
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
  for (const unsigned first : {0x0au, 0x0du, 0x0d0au, 0x0a0du, 0x0a0au, 0x20u, 0x1au, 0u})
    for (const std::string end : {"\n", "\r\n", "\r"}) {
      const float x = std::bit_cast<float>(0x3f800000u + first);
      EXPECT_EQ(read(with_ends([&](int) { return end; }, x)).at.x, std::vector<float>{x})
          << first << ' ' << int(end[0]);
    }
  const float x = std::bit_cast<float>(0x3f80000au);
  for (const std::string one : {"\n", "\r\n"})  // either is one end, whatever the others are
    EXPECT_EQ(read(with_ends([&](int line) { return line % 2 == 0 ? "\n" : one; }, x)).at.x, std::vector<float>{x});
}

TEST(ReadPly, RefusesAHeadWhoseLinesEndOtherwiseThanTheFirst) {
  for (const std::string first : {"\n", "\r\n", "\r"})
    for (const std::string other : {"\n", "\r\n", "\r"})
      for (const int odd : {2, 3, 7, 8}) {
        if ((first == "\r") == (other == "\r")) continue;
        const std::string text = with_ends([&](int line) { return line == odd ? other : first; }, 1);
        if (first == "\r" && other == "\r\n" && text.find("end_header\r\n") != text.npos) continue;  // LF is data
        try {
          read(text);
          ADD_FAILURE() << "was taken: " << text;
        } catch (const app::files::MeshFileError& error) {
          const std::string line = error.what();
          EXPECT_NE(line.find("end all lines of the header alike"), line.npos) << line;
        }
      }
  EXPECT_THROW(read("ply\nformat ascii 1.0\ncomment a\rproperty\n"), app::files::MeshFileError);
}

TEST(ReadPly, TakesAByteOrderMark) {
  for (const char* format : {"ascii", "binary_little_endian"}) {
    const std::string text = "\xEF\xBB\xBF" + ply({{1, 2, 3}}, {}, {.format = format});
    EXPECT_EQ(read(text).at.x, std::vector<float>{1});
    const TemporaryFolder folder;
    EXPECT_EQ(app::files::read_bodies(folder.write("a.obj", text)).at.x, std::vector<float>{1});
  }
  try {
    read("\xFF\xFEp\0l\0y\0\n");
    FAIL();
  } catch (const app::files::MeshFileError& error) {
    EXPECT_NE(std::string(error.what()).find("a.ply:1: is UTF-16; save it as UTF-8"), std::string::npos)
        << error.what();
  }
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

TEST(ReadPly, TakesFilesForPlyByTheirFirstLine) {
  const TemporaryFolder folder;
  const std::string text = ply({{1, 2, 3}}, {});
  EXPECT_EQ(app::files::read_bodies(folder.write("a.obj", text)).at.x.size(), 1u);
  EXPECT_EQ(app::files::read_bodies(folder.write("b.PLY", text)).at.x.size(), 1u);
}

TEST(ReadPly, WithstandsAnyBytes) {
  const TemporaryFolder folder;
  std::mt19937 random(1);
  int read = 0, refused = 0;
  const std::vector<PlyForm> forms = ply_forms();
  for (std::size_t i = 0; i < 3000; ++i) {
    std::string text =
        ply({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {2, 1, 3}}, forms[i % forms.size()]);
    for (unsigned changes = 1 + random() % 3; changes > 0; --changes) {
      const std::size_t at = random() % text.size();
      if (random() % 4 == 0)
        text.resize(at + 1);
      else
        text[at] = static_cast<char>(random() % 3 == 0 ? random() % 256
                                                       : static_cast<unsigned char>(text[at]) ^ (1u << (random() % 4)));
    }
    const auto file = folder.write(std::to_string(i) + ".ply", text);
    try {
      const BodyFile b = app::files::read_bodies(file);
      ++read;
      ASSERT_EQ(b.meshes.vertex_count(), b.at.x.size());
      for (const float x : b.at.x) ASSERT_TRUE(std::isfinite(x));
      for (std::size_t k = 0; k < b.meshes.count(); ++k) {
        for (const auto& [p, q] : b.meshes.edges(k)) ASSERT_TRUE(p < b.meshes.size(k) && q < b.meshes.size(k));
      }
    } catch (const app::files::MeshFileError& error) {
      ++refused;
      const std::string line = error.what();
      ASSERT_TRUE(line.starts_with(file.string() + ":")) << line;
      for (const char c : line) ASSERT_TRUE(c >= ' ' && c <= '~') << line;
    }
  }
  EXPECT_GT(read, 200);
  EXPECT_GT(refused, 400);
}

}  // namespace THIS_FILE
}  // namespace cli::test
