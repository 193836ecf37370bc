// `detect` on bad input: status 2, no incomplete file, and one line that names the option, or the file and its line.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <span>

#include "tests/cli/detect_rig.h"
#include "tests/cli/ply_rig.h"

namespace cli::test {
namespace THIS_FILE {

/// Returns a text, repeated so many times.
std::string repeated(const std::string& piece, std::size_t times) {
  std::string text;
  text.reserve(piece.size() * times);
  while (times-- > 0) text += piece;
  return text;
}

struct BadFile {
  const char* name;
  std::string text;
  Words words;
};

/// Expects that `detect` refuses each file with its name and these words, and writes nothing.
void expect_bad(const std::string& file, std::span<const BadFile> rows) {
  for (const auto& [name, text, words] : rows) {
    SCOPED_TRACE(name);
    const TemporaryFolder folder;
    const std::string bad = folder.write(file, text), out = folder.path() / "out.csv";
    expect_refused({"detect", bad, "--tolerance", "0.1", "--json", "--contacts", out}, with(words, {bad}));
    EXPECT_EQ(file_names(folder.path()), std::set<std::string>{file});
  }
}

const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

const BadFile bad_files[]{
    {"empty", "", {"no vertex"}},
    {"nan", three + "v 0 nan 0\n", {":4: ", "'nan'", "finite"}},
    {"overflow", "v 1e39 0 0\n", {":1: ", "'1e39'"}},
    {"text", "v 0 zero 0\n", {":1: ", "'zero'", "no number"}},
    {"trailing_text", "v 0 0 1.5x\n", {":1: ", "'1.5x'"}},
    {"two_signs", "v 0 0 +-1\n", {":1: ", "'+-1'"}},
    {"comma", "v 0,5 0 0\n", {":1: ", "'0,5'"}},
    {"two_coordinates", "v 1 2\n", {":1: ", "fewer than 3 coordinates"}},
    {"truncated_number", "v 1 2 -", {":1: ", "'-'"}},
    {"merged_lines", "v 1 2 3 4 5 6 7 8\n", {":1: ", "more than 7"}},
    {"two_corners", three + "f 1 2\n", {":4: ", "fewer than 3 corners"}},
    {"index_zero", three + "\n\nf 1 2 0\n", {":6: ", "'0'"}},
    {"index_beyond", three + "f 1 2 4\n", {":4: ", "vertex 4 of 3"}},
    {"index_before", three + "f 1 2 -4\n", {":4: ", "'-4'"}},
    {"index_huge", three + "f 1 2 4294967297\n", {":4: ", "'4294967297'"}},
    {"index_overflow", three + "f 1 2 99999999999999999999\n", {":4: ", "no vertex"}},
    {"index_fraction", three + "f 1 2 3.0\n", {":4: ", "'3.0'"}},
    {"corner_of_slashes", three + "f 1/// 2/ 3/\n", {":4: ", "'1///'", "V/VT"}},
    {"corner_four_parts", three + "f 1/1/1/1 2 3\n", {":4: ", "'1/1/1/1'"}},
    {"across_bodies", three + "o two\nv 5 5 5\nf 1 2 3\nf 1 2 4\n", {":7: ", "across bodies"}},
    {"line_numbers_with_cr", "v 0 0 0\r\rv 0 0 \\\r0 \\\r0\rv nan 0 0\r", {":6: ", "'nan'"}},
    {"line_numbers_with_crlf", "v 0 0 0\r\n\r\nv 0 0 \\\r\n0 \\\r\n0\r\nv nan 0 0\r\n", {":6: ", "'nan'"}},
    {"binary", std::string("\x7f\x45LF\0\x01\x02\n\xff\xfe", 10), {":1: ", "no OBJ statement"}},
    {"control_characters", "v 0 0 \x1b[31m\x07\n", {":1: ", "'?[31m?'"}},
    {"zero_byte", std::string("v 0 0 0\0\nv 1 1 1\n", 17), {":1: ", "'0?'"}},
    {"control_z_between", "v 0 0 0\n\x1a\nv 1 1 1\n", {":2: ", "no OBJ statement"}},
    {"utf_16", std::string("\xff\xfev\0 \0", 6), {":1: ", "UTF-16", "UTF-8"}},
    {"stl", "solid a\nouter loop\nvertex 0 0 0\n", {"no vertex"}},
    {"nan_of_windows", "v 0 0 1.#QNAN\n", {":1: ", "'1.#QNAN'"}},
    {"vertex_after_weight", "v 0 0 0 1v 1 1 1\n", {":1: ", "'1v'"}},
    {"long_line", "# " + std::string(3 << 20, 'x'), {":1: ", "longer than 1 MiB"}},
    {"long_continued_line", "v 0 0 0\nf" + repeated(" 1 \\\n", 400'000), {":2: ", "longer than 1 MiB"}},
};

TEST(DetectErrors, NameTheLineOfABadObjFile) { expect_bad("bad.obj", bad_files); }

const std::string begin_text = "ply\nformat ascii 1.0\n";
const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
const std::string list = "property list uchar int vertex_indices\n";
const std::string vertex = begin_text + "element vertex 1\n", face = begin_text + "element face 1\n";
const std::string point = vertex + xyz + "end_header\n";
/// The head of a text file with three vertices and these faces; its last line is number 9.
std::string with_faces(const std::string& rows, const std::string& count = "1") {
  return begin_text + "element vertex 3\n" + xyz + "element face " + count + "\n" + list +
         "end_header\n0 0 0\n1 0 0\n0 1 0\n" + rows;
}
std::string binary(const std::vector<std::vector<unsigned>>& faces,
                   const std::vector<std::array<float, 3>>& vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}) {
  return ply(vertices, faces, {.format = "binary_little_endian"});
}
std::string cut(std::string text, std::size_t bytes) { return text.substr(0, text.size() - bytes); }
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

const BadFile bad_ply_files[]{
    {"empty", "", {":1: ", "'ply'"}},
    {"obj", "v 0 0 0\n", {":1: ", "'ply'"}},
    {"no_header", "ply\n", {":2: ", "'end_header'"}},
    {"header_cut_off", vertex + xyz, {":7: ", "'end_header'"}},
    {"no_format", "ply\nelement vertex 1\n" + xyz + "end_header\n0 0 0\n", {":6: ", "'format'"}},
    {"unknown_format", "ply\nformat utf8 1.0\n", {":2: ", "'utf8'"}},
    {"unknown_line", begin_text + "vertices 3\n", {":3: ", "'vertices'"}},
    {"unknown_type", vertex + "property half x\n", {":4: ", "'half'"}},
    {"no_count", begin_text + "element vertex\n", {":3: ", "NAME COUNT"}},
    {"count_of_text", begin_text + "element vertex 3x\n", {":3: ", "NAME COUNT"}},
    {"huge_count", begin_text + "element vertex 4000001\n", {":3: ", "more than 4000000 vertices"}},
    {"overflowing_count", begin_text + "element vertex 99999999999999999999\n", {":3: ", "NAME COUNT"}},
    {"two_elements_vertex", vertex + xyz + "element vertex 1\n", {":7: ", "second element 'vertex'"}},
    {"property_first", begin_text + "property float x\n", {":3: ", "before the first element"}},
    {"list_of_real_length", face + "property list float int vertex_indices\n", {":4: ", "length"}},
    {"real_indices", face + "property list uchar float vertex_indices\n", {":4: ", "indices"}},
    {"two_lists", face + list + "property list uchar int vertex_index\n", {":5: ", "second list"}},
    {"no_y", vertex + "property float x\nproperty float z\nend_header\n0 0\n", {":6: ", "x, y and z"}},
    {"list_for_x", vertex + "property list uchar float x\nend_header\n0\n", {":5: ", "x, y and z"}},
    {"no_indices", vertex + xyz + "element face 1\nproperty int i\nend_header\n0 0 0\n1\n", {":9: ", "vertex_indices"}},
    {"no_property", begin_text + "element other 9000000000000\nend_header\n", {":4: ", "'other'", "no property"}},
    {"no_vertex", begin_text + "element vertex 0\n" + xyz + "end_header\n", {"no vertex"}},
    {"cut_off_in_vertices", begin_text + "element vertex 2\n" + xyz + "end_header\n0 0 0\n", {":9: ", "the file ends"}},
    {"cut_off_in_a_row", cut(with_faces("3 0 1 2\n"), 3), {":14: ", "the file ends"}},
    {"too_many_faces_said", with_faces("3 0 1 2\n", "2"), {":14: ", "the file ends"}},
    {"too_few_faces_said", with_faces("3 0 1 2\n3 0 1 2\n"), {":14: ", "goes on"}},
    {"many_faces_said", with_faces("3 0 1 2\n", "4000000000000000000"), {":14: ", "the file ends"}},
    {"vertex_of_four", point + "0 0 0 1\n", {":8: ", "more numbers"}},
    {"nan", point + "0 nan 0\n", {":8: ", "'nan'"}},
    {"two_corners", with_faces("2 0 1\n"), {":13: ", "fewer than 3 corners"}},
    {"length_below_zero", replaced(with_faces("-3 0 1 2\n"), "uchar", "char"), {":13: ", "-3 items"}},
    {"index_below_zero", with_faces("3 0 1 -1\n"), {":13: ", "vertex -1"}},
    {"index_beyond", with_faces("3 0 1 3\n"), {":13: ", "vertex 3 of 3"}},
    {"index_fraction", with_faces("3 0 1 1.5\n"), {":13: ", "'1.5'"}},
    {"binary_cut_off", cut(binary({{0, 1, 2}}), 1), {"element 'face', row 0 (counted from 0)", "the file ends"}},
    {"binary_without_rows", cut(binary({}), 36), {"element 'vertex', row 0", "the file ends"}},
    {"binary_goes_on", binary({{0, 1, 2}}) + "x", {"goes on"}},
    {"binary_nan", binary({}, {{0, 0, 0}, {0, NAN, 0}}), {"element 'vertex', row 1", "not finite"}},
    {"binary_overflow", ply({{0, 0, INFINITY}}, {}, {"binary_big_endian", "double"}), {"row 0", "not finite"}},
    {"binary_two_corners", binary({{0, 1, 2}, {0, 1}}), {"element 'face', row 1", "fewer than 3 corners"}},
    {"binary_index_beyond", binary({{0, 1, 2}, {0, 1, 3}}), {"face 1 (counted from 0)", "vertex 3 of 3"}},
    {"binary_index_below_zero", binary({{0, 1, 4294967295}}), {"row 0", "vertex -1"}},
    {"long_row", with_faces("3 0 1 2 " + std::string(2 << 20, '1') + "\n"), {":13: ", "longer than 1 MiB"}},
    {"control_characters", vertex + "property fl\x1b[31m x\n", {":4: ", "'fl?[31m'"}},
};

TEST(DetectErrors, NameThePlaceInABadPlyFile) { expect_bad("bad.ply", bad_ply_files); }

class DetectRefuses : public testing::Test {
 protected:
  /// Expects that `detect good.obj` refuses what follows, and writes nothing.
  void refuse(const Words& more, const Words& words) {
    expect_refused(with({"detect", good}, more), words);
    EXPECT_EQ(file_names(folder.path()), before);
  }

  TemporaryFolder folder;
  std::string good = folder.write("good.obj", three + "f 1 2 3\no b\nv 0 0 1\n");
  std::string fewer = folder.write("fewer.obj", "v 0 0 0\nv 1 0 0\no b\nv 0 1 0\nv 1 1 1\n");
  std::string lone = folder.write("lone.obj", three + "v 1 2 3\n");
  std::set<std::string> before = file_names(folder.path());
};

TEST_F(DetectRefuses, FilesThatDoNotMatch) {
  refuse({fewer, "--tolerance", "1"}, {fewer, good, "body 0", "2", "3"});
  refuse({lone, "--tolerance", "1"}, {lone, good, "number of bodies"});
  refuse({"--rest", fewer, "--tolerance", "1"}, {fewer, "body 0"});
  refuse({"--rest", lone, "--tolerance", "1"}, {lone, "number of bodies"});
}

TEST_F(DetectRefuses, FilesWhoseBodiesHaveOtherVertices) {
  const auto file = [&](const std::string& name, const std::vector<std::vector<unsigned>>& faces, float x) {
    before.insert(name);
    return folder.write(name, ply({{x, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}, {5, 0, 0}}, faces)).string();
  };
  const std::string parts = file("parts.ply", {{0, 1, 2}, {3, 4, 5}}, 0),
                    sizes = file("sizes.ply", {{0, 1, 2}, {2, 3, 0}, {4, 5, 5}}, 0),
                    mixed = file("mixed.ply", {{0, 1, 3}, {2, 4, 5}}, 0), fine = file("fine.ply", {}, 1),
                    few = folder.write("few.ply", ply({{0, 0, 0}}, {}));
  before.insert("few.ply");
  good = parts;
  EXPECT_EQ(run({"detect", parts, fine, parts, "--rest", fine, "--tolerance", "1"}).status, 0);
  refuse({sizes, "--tolerance", "1"}, {sizes, parts, "body 0", "4", "3"});
  refuse({mixed, "--tolerance", "1"}, {mixed, parts, "body 0 has other vertices"});
  refuse({few, "--tolerance", "1"}, {few, parts, "number of bodies 1"});
  EXPECT_EQ(run({"detect", parts, mixed, "--bodies", "one", "--tolerance", "1"}).status, 0);
}

TEST_F(DetectRefuses, FilesThatCannotBeRead) {
  const std::string missing = folder.path() / "missing.obj", inside = good + "/x.obj";
  refuse({missing, "--tolerance", "1"}, {missing, "cannot be read"});
  refuse({inside, "--tolerance", "1"}, {inside, "cannot be read"});
  refuse({"--rest", missing, "--tolerance", "1"}, {missing, "cannot be read"});
  refuse({folder.path().string(), "--tolerance", "1"}, {folder.path().string(), "cannot be read"});
  expect_refused({"detect", "/dev/zero", "--tolerance", "1"}, {"/dev/zero:1: "});
}

TEST_F(DetectRefuses, TheFirstLineBeyondALimit) {
  const std::string more = ":4000001: more than 4000000 ";
  const std::vector<std::array<std::string, 2>> files{
      {repeated("v 0 0 0\n", 4'000'001), more + "vertices"},
      {repeated("o\n", 4'000'001), more + "objects"},
      {"v 0 0 0\n" + repeated("f" + repeated(" 1", 8'000) + "\n", 4'001), ":4002: more than 32000000 corners"}};
  for (const auto& [text, what] : files) {
    const std::string large = folder.write("large.obj", text);
    expect_refused({"detect", large, "--tolerance", "1"}, {large + what, "coarser"});
  }
}

TEST_F(DetectRefuses, TooManyFramesAfterTheFirst) {
  const Words files(1000, folder.write("one.obj", repeated("v 0 0 0\n", 134'218)));
  expect_refused(with({"detect", "--tolerance", "1"}, files),
                 {"1000 files of 134218 vertices each", "at most 134217728", "fewer files"});
}

TEST_F(DetectRefuses, BadFacesOfLaterFiles) {
  const std::string bad = folder.write("bad.obj", three + "f 1 2 9\no b\nv 0 0 1\n");
  before.insert("bad.obj");
  refuse({bad, "--tolerance", "1"}, {bad + ":4: "});
  refuse({"--rest", bad, "--tolerance", "1"}, {bad + ":4: "});
}

TEST_F(DetectRefuses, AContactsFileThatCannotBeWritten) {
  const std::string nowhere = folder.path() / "none" / "out.csv", below_file = good + "/out.csv", dir = folder.path();
  for (const std::string& out : {nowhere, below_file, dir})
    refuse({"--tolerance", "1", "--json", "--contacts", out}, {out, "cannot be written"});
  if (std::filesystem::exists("/dev/full"))
    refuse({"--tolerance", "1", "--contacts", "/dev/full"}, {"/dev/full", "not a regular file"});
}

TEST_F(DetectRefuses, AMeshAsTheContactsFile) {
  const std::string text = read_file(good), lone_text = read_file(lone);
  refuse({"--tolerance", "1", "--contacts", good}, {good, "is the input"});
  refuse({"--rest", good, "--tolerance", "1", "--contacts", folder.path() / "." / "good.obj"},
         {"is the input " + good});
  refuse({"--tolerance", "1", "--contacts", lone}, {lone, "not a file of this kind"});  // after a name left out
  EXPECT_EQ(read_file(good), text);
  EXPECT_EQ(read_file(lone), lone_text);
}

TEST_F(DetectRefuses, AMeshAsStandardOutput) {
  const std::string text = read_file(good);
  const std::string command = SBCOLLIDE_PROGRAM " detect " + good + " --tolerance 1 >> " + good + " 2>/dev/null";
  EXPECT_NE(std::system(command.c_str()), 0);
  EXPECT_EQ(read_file(good), text);
}

}  // namespace THIS_FILE
}  // namespace cli::test
