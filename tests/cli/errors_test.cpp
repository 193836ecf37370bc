// Bad input: status 2, nothing on standard output, and one line on standard error that names what is wrong.

#include <gtest/gtest.h>

#include "tests/cli/process.h"

namespace cli::test {
namespace THIS_FILE {

struct Bad {
  const char* name;
  std::vector<std::string> arguments;
  std::vector<std::string> says;
};

class BadCommandLine : public testing::TestWithParam<Bad> {};

TEST_P(BadCommandLine, IsRefusedInOneLine) { expect_refused(GetParam().arguments, GetParam().says); }

std::vector<std::string> drop(std::vector<std::string> more) {
  more.insert(more.begin(), {"simulate", "--scene", "drop", "--frames", "2", "--json"});
  return more;
}

const Bad bad_lines[]{
    {"unknown_scene", {"simulate", "--scene", "dorp", "--frames", "2"}, {"'dorp'", "drop"}},
    {"mesh_as_scene", {"simulate", "--scene", "cube.obj", "--frames", "2"}, {"--scene cube.obj", "--mesh"}},
    {"ply_as_scene", {"simulate", "--scene", "cube.ply", "--frames", "2"}, {"--scene cube.ply", "--mesh"}},
    {"missing_mesh", {"--mesh", "none.obj"}, {"--mesh", "none.obj"}},
    {"missing_scene_file", {"simulate", "--scene", "none.toml", "--frames", "2"}, {"none.toml", "cannot be read"}},
    {"unknown_method", drop({"--method", "magic"}), {"--method magic", "brute-force"}},
    {"unknown_integrator", drop({"--integrator", "magic"}), {"--integrator magic", "semi-implicit-euler"}},
    {"unknown_contact_surface", drop({"--contact-surface", "magic"}), {"magic", "vertex-vertex, surface"}},
    {"value_of_a_flag",
     {"simulate", "--scene", "drop", "--frames", "2", "--no-self=maybe"},
     {"--no-self", "without a value"}},
    {"number_for_a_flag",
     {"simulate", "--scene", "drop", "--json=99999999999999999999"},
     {"--json", "without a value"}},
    {"number_for_help", {"simulate", "--help=99999999999999999999"}, {"--help", "without a value"}},
    {"oracle_without_json", {"simulate", "--scene", "drop", "--frames", "2", "--oracle"}, {"--oracle", "--json-lines"}},
    {"json_lines_beside_json", drop({"--json-lines"}), {"--json-lines", "--json"}},
    {"number_for_json_lines", {"simulate", "--scene", "drop", "--json-lines=3"}, {"--json-lines", "without a value"}},
    {"json_lines_of_detect", {"detect", "a.obj", "--tolerance", "1", "--json-lines"}, {"--json-lines"}},
    {"unknown_option", drop({"--magic"}), {"--magic"}},
    {"unknown_command", {"magic"}, {"magic"}},
    {"unknown_list", {"list", "magic"}, {"magic", "scenes"}},
    {"frames_zero", {"simulate", "--scene", "drop", "--frames", "0"}, {"--frames"}},
    {"frames_negative", {"simulate", "--scene", "drop", "--frames", "-3"}, {"--frames"}},
    {"frames_text", {"simulate", "--scene", "drop", "--frames", "many"}, {"--frames"}},
    {"frames_fraction",
     {"simulate", "--scene", "drop", "--frames", "2.5"},
     {"--frames", "must be a whole number from 1 to 10000000", "2.5"}},
    {"frames_huge", {"simulate", "--scene", "drop", "--frames", "99999999999999999999"}, {"--frames"}},
    {"levels_16", drop({"--levels", "16"}), {"levels", "0 to 15"}},
    {"levels_negative", drop({"--levels", "-1"}), {"levels", "0 to 15"}},
    {"levels_text", drop({"--levels", "x"}), {"--levels"}},
    {"levels_fraction", drop({"--levels", "2.5"}), {"--levels", "must be a whole number from 0 to 15"}},
    {"buckets_zero", drop({"--buckets", "0"}), {"buckets", "16777216"}},
    {"buckets_negative", drop({"--buckets", "-5"}), {"buckets"}},
    {"buckets_too_many", drop({"--buckets", "16777217"}), {"buckets", "16777216"}},
    {"buckets_wrapping", drop({"--buckets", "4294967297"}), {"buckets"}},
    {"buckets_fraction", drop({"--buckets", "2.5"}), {"--buckets", "must be a whole number from 1 to 16777216"}},
    {"cell_zero", drop({"--cell-size", "0"}), {"cell size"}},
    {"cell_nan", drop({"--cell-size", "nan"}), {"cell size"}},
    {"cell_overflow", drop({"--cell-size", "1e300"}), {"cell size"}},
    {"cell_text", drop({"--cell-size", "wide"}), {"--cell-size wide", "auto"}},
    {"cell_two", drop({"--cell-size", "1,2"}), {"--cell-size 1,2", "X,Y,Z"}},
    {"cell_negative_side", drop({"--cell-size", "1,2,-3"}), {"cell size"}},
    {"cell_beyond_scene_files",
     drop({"--cell-size", "1e30"}),
     {"--cell-size 1e30: must be a number of metres from 1e-09 to 1000000"}},
    {"cell_below_scene_files", drop({"--cell-size", "1e-30"}), {"--cell-size 1e-30", "from 1e-09 to 1000000"}},
    {"cell_side_beyond_scene_files", drop({"--cell-size", "1,2,1e7"}), {"--cell-size 1,2,1e7", "from 1e-09"}},
    {"view_five", drop({"--view", "0,1,0,8,30"}), {"--view 0,1,0,8,30", "X,Y,Z,DISTANCE,AZIMUTH,ELEVATION"}},
    {"view_text", drop({"--view", "0,1,0,8,30,up"}), {"--view"}},
    {"view_too_close", drop({"--view", "0,1,0,0,30,0"}), {"--view"}},
    {"view_upside_down", drop({"--view", "0,1,0,8,30,120"}), {"--view", "-89 to 89"}},
    {"view_nan", drop({"--view", "0,1,0,8,nan,0"}), {"--view"}},
    {"obj_every_zero", drop({"--obj-every", "0"}), {"--obj-every"}},
    {"obj_every_beyond", drop({"--obj-every", "3"}), {"--obj-every 3", "--frames 2"}},
    {"obj_folder", drop({"--obj-every", "1", "--out", "/proc/none"}), {"--out /proc/none"}},
    {"primes_two", drop({"--primes", "2,3"}), {"--primes 2,3", "three whole numbers"}},
    {"primes_four", drop({"--primes", "2,3,5,7"}), {"--primes", "three"}},
    {"primes_zero", drop({"--primes", "2,0,5"}), {"--primes", "from 1 to 4294967295"}},
    {"primes_negative", drop({"--primes", "-2,3,5"}), {"--primes"}},
    {"primes_too_large", drop({"--primes", "2,3,4294967296"}), {"--primes"}},
    {"primes_text", drop({"--primes", "two,3,5"}), {"--primes two,3,5"}},
    {"primes_fraction", drop({"--primes", "2,3,5.0"}), {"--primes"}},
    {"primes_space", drop({"--primes", "2, 3,5"}), {"--primes"}},
    {"primes_nothing", drop({"--primes", ""}), {"--primes"}},
    {"tolerance_zero", drop({"--tolerance", "0"}), {"tolerance"}},
    {"tolerance_negative", drop({"--tolerance", "-0.1"}), {"tolerance"}},
    {"tolerance_with_a_comma", drop({"--tolerance", "0,1"}), {"--tolerance = 0,1: is no number"}},
    {"tolerance_nan", drop({"--tolerance", "nan"}), {"tolerance"}},
    {"tolerance_infinite", drop({"--tolerance", "inf"}), {"tolerance"}},
    {"tolerance_below_scene_files",
     drop({"--tolerance", "1e-10"}),
     {"--tolerance 1e-10: must be a number of metres from 1e-09 to 10"}},
    {"tolerance_denormal",
     drop({"--tolerance", "1e-40"}),
     {"--tolerance 1e-40: must be a number of metres from 1e-09"}},
    {"tolerance_huge", drop({"--tolerance", "5e29"}), {"--tolerance 5e+29: must be", "from 1e-09 to 10"}},
    {"tolerance_beyond_scene_files", drop({"--tolerance", "10.1"}), {"--tolerance 10.1", "from 1e-09 to 10"}},
    {"tolerance_text", drop({"--tolerance", "0.1m"}), {"--tolerance"}},
    {"dt_zero", drop({"--dt", "0"}), {"--dt"}},
    {"dt_negative", drop({"--dt", "-0.01"}), {"--dt"}},
    {"dt_nan", drop({"--dt", "nan"}), {"--dt"}},
    {"dt_large", drop({"--dt", "1000"}), {"--dt"}},
    {"threads_zero", drop({"--threads", "0"}), {"--threads"}},
    {"threads_many", drop({"--threads", "100000"}), {"--threads"}},
    {"size_text", drop({"--size", "large"}), {"--size large", "1280x720"}},
    {"size_one", drop({"--size", "640"}), {"--size"}},
    {"size_zero", drop({"--size", "0x480"}), {"--size"}},
    {"size_negative", drop({"--size", "-640x480"}), {"--size"}},
    {"size_space", drop({"--size", " 640x480"}), {"--size"}},
    {"size_plus", drop({"--size", "+640x+480"}), {"--size"}},
    {"size_cut", drop({"--size", "640x"}), {"--size"}},
    {"size_trailing", drop({"--size", "640x480x3"}), {"--size"}},
    {"size_too_large", drop({"--size", "640x100000"}), {"--size"}},
    {"capture_beyond", drop({"--capture", "1,3"}), {"--capture", "3", "--frames 2"}},
    {"capture_zero", drop({"--capture", "0"}), {"--capture"}},
    {"capture_text", drop({"--capture", "1,last"}), {"--capture", "last"}},
    {"capture_empty_item", drop({"--capture", "1,,2"}), {"--capture"}},
    {"capture_trailing_comma", drop({"--capture", "1,"}), {"--capture 1,", "''"}},
    {"capture_nothing", drop({"--capture", ""}), {"--capture"}},
    {"option_without_value", drop({"--method"}), {"--method"}},
};

INSTANTIATE_TEST_SUITE_P(Lines, BadCommandLine, testing::ValuesIn(bad_lines),
                         [](const auto& i) { return i.param.name; });

TEST(Errors, NameABrokenSceneFileWithItsLine) {
  const TemporaryFolder folder;
  const auto key = folder.write("key.toml", "[[body]]\n\ncolour = 3\n");
  expect_refused({"simulate", "--scene", key, "--frames", "2"}, {key.string() + ":3: ", "colour"});
  const auto syntax = folder.write("syntax.toml", "[[body]\n");
  expect_refused({"simulate", "--scene", syntax, "--frames", "2"}, {syntax.string() + ":1: "});
}

#if SBCOLLIDE_GRAPHICS
TEST(Errors, RefusePicturesWithoutOpenGLBeforeAnythingIsWritten) {
  const TemporaryFolder folder;
  const auto out = folder.path() / "pictures";
  // The loader of EGL drivers finds none.
  expect_refused({"simulate", "--scene", "drop", "--frames", "1", "--capture", "1", "--out", out, "--json"},
                 {"without a window", "install"},
                 {"__EGL_VENDOR_LIBRARY_FILENAMES=" + (folder.path() / "none").string()});
  EXPECT_EQ(file_names(folder.path()), std::set<std::string>{});
}

TEST(Errors, SayWhatToDoWithoutADisplay) {
  expect_refused({}, {"window", "DISPLAY", "simulate"}, {"DISPLAY=", "WAYLAND_DISPLAY=none", "XDG_RUNTIME_DIR="});
}

TEST(Errors, RefuseALengthInTheWindowThatASceneFileRefuses) {
  expect_refused({"--tolerance", "1e-10"}, {"--tolerance 1e-10: must be a number of metres from 1e-09 to 10"});
}

TEST(Errors, NameAFolderThatCannotBeMadeBeforeAnythingRuns) {
  const TemporaryFolder folder;
  const auto file = folder.write("file", "not a folder");  // a regular file stops even root
  for (const auto& out : {file, file / "below"})
    expect_refused({"simulate", "--scene", "drop", "--frames", "5", "--capture", "5", "--out", out, "--json"},
                   {"--out", out.string()});
  EXPECT_EQ(read_file(file), "not a folder");
}
#else
TEST(Errors, RefusePicturesInABuildWithoutGraphics) {
  expect_refused(drop({"--capture", "1"}), {"--capture", "graphics"});
  expect_refused(drop({"--animation", "run.webp"}), {"--animation", "graphics"});
}
TEST(Errors, RefuseTheWindowInABuildWithoutGraphics) { expect_refused({}, {"simulate"}); }
#endif

TEST(Errors, NameAFolderThatCannotBeWrittenToEvenIfNothingWouldBe) {
  const TemporaryFolder folder;
  const auto file = folder.write("file", "not a folder");  // a regular file stops even root
  for (const auto& out : {file, file / "below"})
    for (std::vector<std::string> arguments :
         {drop({}), {"report", "detection"}, {"report", "contact"}, {"report", "solver"}, {"report", "stability"}}) {
      arguments.insert(arguments.end(), {"--out", out});
      expect_refused(arguments, {"--out " + out.string() + ": cannot be written to"});
    }
  const auto mesh = folder.write("mesh.obj", "v 0 0 0\n");
  for (const std::vector<std::string>& detect :
       {std::vector<std::string>{"--tolerance", "1"}, {mesh.string(), "--continuous"}}) {
    std::vector<std::string> arguments{"detect", mesh, "--contacts", file / "contacts.csv"};
    arguments.insert(arguments.end(), detect.begin(), detect.end());
    expect_refused(arguments, {(file / "contacts.csv").string() + ": cannot be written"});
  }
}

}  // namespace THIS_FILE
}  // namespace cli::test
