// The reader of OBJ files: numbers, statements and objects. Lines: tests/softbody; any bytes: tests/fuzz.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/read_bodies.h"
#include "tests/temporary_folder.h"

namespace cli::test {
namespace THIS_FILE {

using app::files::BodyFile;
using app::files::BodyMeshes;
using Edges = std::vector<BodyMeshes::Edge>;

BodyFile read(const std::string& text) {
  const tests::TemporaryFolder folder;
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

const std::string six = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 4 0 0\nv 5 0 0\n";

TEST(ReadObj, GivesObjectsTheVerticesThatTheirFacesName) {
  struct Case {
    std::string text;
    std::vector<collide::Index> first;
    bool noted;  // some object has no vertices of its own
  };
  for (const auto& [text, first, noted] :
       std::vector<Case>{{six + "o a\nf 1 2 3\no b\nf 6 5 4\n", {0, 3, 6}, false},
                         {six + "o a\nf 2 3 4\no b\nf 5 6 5\n", {0, 1, 4, 6}, false},  // vertices that no face names
                         {six + "f 1 2 1\no a\nf 4 3 3\no none\no b\nf 5 6 5\n", {0, 2, 4, 4, 6}, false},
                         {six + "o a\nf 1 2 1\nf 2 3 2\n", {0, 6}, false},
                         {six + "o a\no b\n", {0, 6, 6, 6}, false},  // without faces, empty objects stay so
                         {six + "o a\nf 1 3 5\no b\nf 2 4 6\n", {0, 6, 6, 6}, true},
                         {six + "o a\nf 1 2 3\no b\nf 3 4 5\n", {0, 6, 6, 6}, true},    // they share a vertex
                         {six + "o a\nf 4 5 6\no b\nf 1 2 3\n", {0, 6, 6, 6}, true},    // in another order
                         {six + "o a\nf 1 2 3\no b\nv 9 9 9\n", {0, 6, 6, 7}, true},    // not all vertices stand first
                         {"o a\n" + six + "f 1 2 3\no b\nf 4 5 6\n", {0, 6, 6}, true},  // object a has them all
                         {"o a\n" + six + "o b\nf 1 2 3\n", {0, 6, 6}, true}}) {
    const BodyFile b = read(text);
    EXPECT_EQ(b.meshes.first, first) << text;
    EXPECT_EQ(b.notes.size(), noted ? 1u : 0u) << text;
  }
  EXPECT_EQ(read(six + "o a\nf 1 2 3\no b\nf 6 5 4\n").meshes.edges(1), (Edges{{0, 2}, {2, 1}, {1, 0}}));
}

}  // namespace THIS_FILE
}  // namespace cli::test
