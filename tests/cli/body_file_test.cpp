// The reader of OBJ files: numbers, statements, objects, and random bytes.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/cli/detect_rig.h"
#include "tests/read_bodies.h"

namespace cli::test {
namespace THIS_FILE {

using app::files::BodyFile;
using app::files::BodyMeshes;
using Edges = std::vector<BodyMeshes::Edge>;

BodyFile read(const std::string& text) {
  const TemporaryFolder folder;
  return app::files::read_bodies(folder.write("a.obj", text));
}

TEST(ReadObj, RoundsNumbersCorrectlyToFloats) {
  // By way of a double, the first number would be rounded twice and end one step too low.
  const BodyFile b = read(
      "v 1.000000059604644775390626 16777217.0000001 0.1\nv 1e-50 -1e-400 7.1e-46\n"
      "v +.5 -2.E+1 3.4028235e38\n");
  EXPECT_EQ(b.at.x, (std::vector<float>{1.00000011920928955f, 0.0f, 0.5f}));
  EXPECT_EQ(b.at.y, (std::vector<float>{16777218.0f, 0.0f, -20.0f}));
  EXPECT_EQ(b.at.z, (std::vector<float>{0.1f, 0x1p-149f, 3.4028235e38f}));
  EXPECT_TRUE(std::signbit(b.at.y[1]));
  std::mt19937 random(1);
  std::string text;
  std::vector<float> expected;
  for (int i = 0; i < 2000; ++i) {
    const std::string number = std::to_string(random()) + "." + std::to_string(random()) + "e" +
                               std::to_string(static_cast<int>(random() % 80) - 55);
    expected.push_back(std::strtof(number.c_str(), nullptr));
    if (!std::isfinite(expected.back())) {
      expected.pop_back();
      continue;
    }
    text += "v " + number + " 0 0\n";
  }
  EXPECT_EQ(read(text).at.x, expected);
}

TEST(ReadObj, MakesEachObjectABody) {
  const BodyFile b = read("v 0 0 0\nv 1 0 0\no\no named thing\nv 2 0 0\ng group\nv 3 0 0\nv 4 0 0\no last");
  EXPECT_EQ(b.meshes.first, (std::vector<collide::Index>{0, 2, 2, 5, 5}));
  EXPECT_EQ(read("o only\nv 0 0 0\n").meshes.first, (std::vector<collide::Index>{0, 1}))
      << "no body before the first o";
  EXPECT_EQ(b.meshes.count(), 4u);
}

TEST(ReadObj, ReadsPolygonEdgesFromAllFormsOfFaces) {
  const std::string points = "v 9 9 9\no b\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  const Edges quad{{3, 0}, {0, 1}, {1, 2}, {2, 3}};
  for (const char* face : {"f 2 3 4 5", "f 2/1 3/2 4/3 5/4", "f 2//1 3//1 4//1 5//1", "f 2/1/1 3/1/1 4/1/1 5/-1/-1",
                           "f 2// 3// 4// 5//", "f 2/ 3/ 4/ 5/", "f 2/1/ 3/1/ 4/-1/ 5", "f -4 -3 -2 -1",
                           "f\t2  3 4\t5 # a comment", "f 2 3 \\\n4 5", "f 2 3 4 5 \\\r\n"}) {
    const BodyFile b = read(points + face);
    EXPECT_EQ(b.meshes.edges(1), quad) << face;
    EXPECT_TRUE(b.meshes.edges(0).empty());
  }
  EXPECT_EQ(read("f 2 3 4\n" + points).meshes.edges(1), (Edges{{2, 0}, {0, 1}, {1, 2}})) << "a face may come first";
}

TEST(ReadObj, IgnoresOtherStatementsAndLayout) {
  const BodyFile b = read(
      "\xEF\xBB\xBF# C:\\path\\\nv 1 2 3\r\n\r\n  v 4 5 6 1.0\r\nv 7 8 9 0.5 0.5 0.5\nvt 0 \\\n0\nvn 0 0 1\nvp 1\ng a "
      "b\ns off\n"
      "usemtl m\nmtllib x.mtl\nl 1 2\np 1\nobject 1\nv\t-1\t-2\t-3");
  EXPECT_EQ(b.at.x, (std::vector<float>{1, 4, 7, -1}));
  EXPECT_EQ(b.meshes.first, (std::vector<collide::Index>{0, 4}));
}

TEST(ReadObj, DoesNotContinueANameThatEndsInABackslash) {
  for (const std::string name : {"g a\\", "usemtl C:\\textures\\", "mtllib C:\\\\", "s \\ ", "# C:\\"}) {
    const BodyFile b =
        read(name + "\nv 0 0 0\n" + name + "\r\nv 1 0 0\n" + name + "\rv 0 1 0\n" + name + "\nf 1 2 \\\n3\n");
    EXPECT_EQ(b.at.x.size(), 3u) << name;
    EXPECT_EQ(b.meshes.edges(0).size(), 3u) << name;
  }
  EXPECT_EQ(read("o a\\\nv 0 0 0\no b\\\nv 0 0 0\n").meshes.first, (std::vector<collide::Index>{0, 1, 2}));
}

TEST(ReadObj, IgnoresWeightsAndColours) {
  const BodyFile b = read(
      "v 1 2 3 nan nan nan\nv 4 5 6 1.#QNAN -1.#IND 0\nv 7 8 9 .5 .5\nv 1 1 1 1e999 -inf 2 0.5\nv 2 2 2 1.0\n"
      "v 3 3 3 2\nv 3 3 3 nan\nv 3 3 3 1.#QNAN\n");
  EXPECT_EQ(b.at.x, (std::vector<float>{1, 4, 7, 1, 2, 3, 3, 3}));
  ASSERT_EQ(b.notes.size(), 1u);
  EXPECT_NE(b.notes[0].find("3 vertices have a weight other than 1"), std::string::npos) << b.notes[0];
}

constexpr const char* six = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 4 0 0\nv 5 0 0\n";

TEST(ReadObj, GivesObjectsTheVerticesThatTheirFacesName) {
  using First = std::vector<collide::Index>;
  const auto first_of = [](const std::string& text) {
    const BodyFile b = read(text);
    EXPECT_EQ(b.notes, std::vector<std::string>{}) << text;
    return b.meshes.first;
  };
  EXPECT_EQ(first_of(std::string(six) + "o a\nf 1 2 3\no b\nf 6 5 4\n"), (First{0, 3, 6}));
  EXPECT_EQ(first_of(std::string(six) + "o a\nf 2 3 4\no b\nf 5 6 5\n"), (First{0, 1, 4, 6}))
      << "vertices that no face names";
  EXPECT_EQ(first_of(std::string(six) + "f 1 2 1\no a\nf 4 3 3\no none\no b\nf 5 6 5\n"), (First{0, 2, 4, 4, 6}));
  EXPECT_EQ(first_of(std::string(six) + "o a\nf 1 2 1\nf 2 3 2\n"), (First{0, 6}));
  EXPECT_EQ(first_of(std::string(six) + "o a\no b\n"), (First{0, 6, 6, 6})) << "without faces, empty objects stay so";
  EXPECT_EQ(read(std::string(six) + "o a\nf 1 2 3\no b\nf 6 5 4\n").meshes.edges(1), (Edges{{0, 2}, {2, 1}, {1, 0}}));
}

TEST(ReadObj, NotesObjectsWithoutVerticesOfTheirOwn) {
  const auto noted = [](const std::string& text) {
    const BodyFile b = read(text);
    EXPECT_EQ(b.notes.size(), 1u) << text;
    return b.meshes.first;
  };
  using First = std::vector<collide::Index>;
  const std::string mixed = std::string(six) + "o a\nf 1 3 5\no b\nf 2 4 6\n";
  EXPECT_EQ(noted(mixed), (First{0, 6, 6, 6}));
  EXPECT_EQ(noted(std::string(six) + "o a\nf 1 2 3\no b\nf 3 4 5\n"), (First{0, 6, 6, 6})) << "they share a vertex";
  EXPECT_EQ(noted(std::string(six) + "o a\nf 4 5 6\no b\nf 1 2 3\n"), (First{0, 6, 6, 6})) << "in another order";
  EXPECT_EQ(noted(std::string(six) + "o a\nf 1 2 3\no b\nv 9 9 9\n"), (First{0, 6, 6, 7}))
      << "not all vertices stand first";
  EXPECT_EQ(noted(std::string("o a\n") + six + "f 1 2 3\no b\nf 4 5 6\n"), (First{0, 6, 6})) << "object a has them all";
  EXPECT_EQ(noted(std::string("o a\n") + six + "o b\nf 1 2 3\n"), (First{0, 6, 6}));
}

TEST(ReadObj, ReadsLinesAcrossTheEndsOfPieces) {
  std::string text;
  constexpr std::size_t count = 150'000;  // some pieces of 1 MiB
  for (std::size_t i = 0; i < count; ++i)
    text += i % 3 ? "v " + std::to_string(i) + " 0 0\n" : "v " + std::to_string(i) + " \\\r\n 0 0\n";
  const BodyFile b = read(text);
  ASSERT_EQ(b.at.x.size(), count);
  for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(b.at.x[i], static_cast<float>(i));
}

/// Returns the text with a few bytes changed, removed or doubled, or cut short.
std::string mutated(std::string text, std::mt19937& random) {
  static const std::string spice("\0\n\r\\/-+#.e0f vo\xff", 17);
  for (unsigned n = 1 + random() % 4; n > 0 && !text.empty(); --n) {
    const std::size_t at = random() % text.size();
    switch (random() % 6) {
      case 0:
        text[at] = static_cast<char>(random() % 256);
        break;
      case 1:
        text[at] = spice[random() % spice.size()];
        break;
      case 2:
        text.erase(at, 1 + random() % 20);
        break;
      case 3: {
        const std::size_t from = random() % text.size();
        text.insert(at, text.substr(from, random() % 60));
        break;
      }
      case 4:
        text.insert(at, 1, spice[random() % spice.size()]);
        break;
      default:
        if (random() % 8 == 0) text.resize(at);
    }
  }
  return text;
}

TEST(ReadObj, WithstandsAnyBytes) {
  const TemporaryFolder folder;
  std::mt19937 random(1);
  const std::string sources[]{
      random_state(1).obj().substr(0, 3000) + "\n",
      "v 0 0 0\nv 1 0 0 1 0.5\no b\nv 1 1 0\nv 0 1e-3 0\nv 0 0 1\nf 3/1/1 4//2 5/3 \\\n-1\nf -3 -2 -1\no c\n# end\n"};
  int read = 0, refused = 0;
  for (int i = 0; i < 3000; ++i) {
    // A new file each time: some file systems flush a file to disk that replaces another.
    const auto file = folder.write(std::to_string(i) + ".obj", mutated(sources[i % 2], random));
    try {
      const BodyFile b = app::files::read_bodies(file);
      ++read;
      ASSERT_EQ(b.meshes.first.front(), 0u);
      ASSERT_EQ(b.meshes.first.back(), b.at.x.size());
      ASSERT_EQ(b.meshes.first_polygon.size(), b.meshes.count() + 1);
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
