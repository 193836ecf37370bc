// The reader of OBJ files itself: numbers, statements, and that no bytes can harm it.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "app/files/obj.h"
#include "tests/cli/detect_rig.h"

namespace cli::test {
namespace {

using app::ObjBodies;
using Edges = std::vector<ObjBodies::Edge>;

ObjBodies read(const std::string& text) {
  const TemporaryFolder folder;
  return app::read_obj(folder.write("a.obj", text));
}

TEST(Obj, NumbersAreRoundedCorrectlyToFloats) {
  // Through a double, the first rounds twice and ends one step too low.
  const ObjBodies b = read(
      "v 1.000000059604644775390626 16777217.0000001 0.1\nv 1e-50 -1e-400 7.1e-46\n"
      "v +.5 -2.E+1 3.4028235e38\n");
  EXPECT_EQ(b.x, (std::vector<float>{1.00000011920928955f, 0.0f, 0.5f}));
  EXPECT_EQ(b.y, (std::vector<float>{16777218.0f, 0.0f, -20.0f}));
  EXPECT_EQ(b.z, (std::vector<float>{0.1f, 0x1p-149f, 3.4028235e38f}));
  EXPECT_TRUE(std::signbit(b.y[1]));
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
  EXPECT_EQ(read(text).x, expected);
}

TEST(Obj, EveryObjectIsABody) {
  const ObjBodies b = read("v 0 0 0\nv 1 0 0\no\no named thing\nv 2 0 0\ng group\nv 3 0 0\nv 4 0 0\no last");
  EXPECT_EQ(b.first, (std::vector<collide::Index>{0, 2, 2, 5, 5}));
  EXPECT_EQ(read("o only\nv 0 0 0\n").first, (std::vector<collide::Index>{0, 1})) << "nothing before the first o";
  EXPECT_EQ(b.edges.size(), 4u);
}

TEST(Obj, FacesOfAllFormsGivePolygonEdges) {
  const std::string points = "v 9 9 9\no b\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  const Edges quad{{3, 0}, {0, 1}, {1, 2}, {2, 3}};
  for (const char* face : {"f 2 3 4 5", "f 2/1 3/2 4/3 5/4", "f 2//1 3//1 4//1 5//1", "f 2/1/1 3/1/1 4/1/1 5/-1/-1",
                           "f -4 -3 -2 -1", "f\t2  3 4\t5 # a comment", "f 2 3 \\\n4 5", "f 2 3 4 5 \\\r\n"}) {
    const ObjBodies b = read(points + face);
    EXPECT_EQ(b.edges[1], quad) << face;
    EXPECT_TRUE(b.edges[0].empty());
  }
  EXPECT_EQ(read("f 2 3 4\n" + points).edges[1], (Edges{{2, 0}, {0, 1}, {1, 2}})) << "a face may come first";
}

TEST(Obj, OtherStatementsAndLayoutDoNotMatter) {
  const ObjBodies b = read(
      "\xEF\xBB\xBF# C:\\path\\\nv 1 2 3\r\n\r\n  v 4 5 6 1.0\r\nv 7 8 9 0.5 0.5 0.5\nvt 0 \\\n0\nvn 0 0 1\nvp 1\ng a "
      "b\ns off\n"
      "usemtl m\nmtllib x.mtl\nl 1 2\np 1\nobject 1\nv\t-1\t-2\t-3");
  EXPECT_EQ(b.x, (std::vector<float>{1, 4, 7, -1}));
  EXPECT_EQ(b.first, (std::vector<collide::Index>{0, 4}));
}

TEST(Obj, LinesAreWholeWhereverThePiecesEnd) {
  std::string text;
  constexpr std::size_t count = 150'000;  // some pieces of 1 MiB
  for (std::size_t i = 0; i < count; ++i)
    text += i % 3 ? "v " + std::to_string(i) + " 0 0\n" : "v " + std::to_string(i) + " \\\r\n 0 0\n";
  const ObjBodies b = read(text);
  ASSERT_EQ(b.x.size(), count);
  for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(b.x[i], static_cast<float>(i));
}

/// A few bytes changed, removed, doubled, or cut off.
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

TEST(Obj, NoBytesCanHarmTheReader) {
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
      const ObjBodies b = app::read_obj(file);
      ++read;
      ASSERT_EQ(b.first.front(), 0u);
      ASSERT_EQ(b.first.back(), b.x.size());
      ASSERT_EQ(b.edges.size(), b.count());
      for (const float x : b.x) ASSERT_TRUE(std::isfinite(x));
      for (std::size_t k = 0; k < b.count(); ++k) {
        for (const auto& [p, q] : b.edges[k]) ASSERT_TRUE(p < b.size(k) && q < b.size(k));
      }
    } catch (const app::ObjError& error) {
      ++refused;
      const std::string line = error.what();
      ASSERT_TRUE(line.starts_with(file.string() + ":")) << line;
      for (const char c : line) ASSERT_TRUE(c >= ' ' && c <= '~') << line;
    }
  }
  EXPECT_GT(read, 200);
  EXPECT_GT(refused, 400);
}

}  // namespace
}  // namespace cli::test
