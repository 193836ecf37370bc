// Bad input: status 2, nothing on standard output, and one line on standard error that names what is wrong.

#include <gtest/gtest.h>

#include "tests/cli/process.h"

namespace cli::test {
namespace THIS_FILE {

const Words drop{"simulate", "--scene", "drop", "--frames", "2", "--json"};
const std::string mesh = std::string(SBCOLLIDE_SCENES) + "/../meshes/star.obj";
const Words detect_mesh{"detect", mesh, "--tolerance", "1"};

TEST(Errors, NameTheOptionWithABadValue) {
  struct BadValues {
    Words command;
    std::string option;
    Words values, says;
    bool says_value = false;  // behind the option
  };
  const std::string triple = ": must be three whole numbers from 1 to 4294967295",
                    metres = ": must be a number of metres, three of them as X,Y,Z, or auto";
  for (const auto& [command, option, values, says, says_value] : std::vector<BadValues>{
           {drop, "--frames", {"0", "-3", "many", "2.5", "99999999999999999999"}, {"whole number from 1 to 10000000"}},
           {drop, "--levels", {"16", "-1"}, {"must be a whole number from 0 to 15"}},
           {drop, "--buckets", {"0", "-5", "16777217", "4294967297"}, {"must be a whole number from 1 to 16777216"}},
           {drop, "--cell-size", {"0", "nan", "1e300", "1,2,-3"}, {"cell size"}},
           {drop, "--cell-size", {"1e30", "1e-30", "1,2,1e7"}, {" metres from 1e-09 to 1000000"}},
           {drop, "--tolerance", {"0", "-0.1", "nan", "inf", "1e-10", "1e-40", "5e+29", "10.1"}, {"from 1e-09 to 10"}},
           {drop, "--tolerance", {"0,1", "0.1m"}, {": is no number"}, true},
           {drop,
            "--view",
            {"0,1,0,8,30", "0,1,0,8,30,up", "0,1,0,0,30,0", "0,1,0,8,30,120", "0,1,0,8,nan,0"},
            {": must be X,Y,Z,DISTANCE,AZIMUTH,ELEVATION", "-89 to 89"}},
           {drop, "--obj-every", {"0"}, {"must be a whole number from 1"}},
           {drop, "--obj-every", {"3"}, {"lies beyond --frames 2"}},
           {drop, "--dt", {"0", "-0.01", "nan", "1000"}, {"must be a number of seconds from 1e-6 to 1"}},
           {drop,
            "--size",
            {"large", "640", "0x480", "-640x480", " 640x480", "+640x+480", "640x", "640x480x3", "640x100000"},
            {": must be WIDTHxHEIGHT, each from 1 to 16384"}},
           {drop, "--capture", {"1,3"}, {"'3' lies beyond --frames 2"}},
           {drop, "--capture", {"0", "1,last", "1,,2", "1,"}, {"' is no frame number"}},
           {drop, "--method", {"magic"}, {": unknown; use one of: brute-force"}},
           {drop, "--integrator", {"magic"}, {": unknown; use one of: ", "semi-implicit-euler"}},
           {drop, "--contact-surface", {"magic"}, {": unknown; use one of: vertex-vertex, surface"}},
           {drop, "--beside", {"levels", "levels=", "levels=,method=grid-hash"}, {"levels: its value is missing"}},
           {drop, "--beside", {"level=3", "frames=7", "=3", ","}, {"' is none of: method, levels, cell-size"}},
           {drop, "--beside", {"levels=3,levels=4", "levels=3,method=grid-hash,levels=3"}, {"levels: is given twice"}},
           {drop, "--beside", {"levels=16", "levels=x"}, {"--levels: must be a whole number from 0 to 15"}},
           {drop, "--beside", {"method=magic", "contact-surface=magic", "integrator=magic"}, {": unknown; use one of"}},
           {drop, "--beside", {"tolerance=-1", "buckets=0", "cell-size=1,2"}, {": must be "}},
           {detect_mesh, "--levels", {"-1", "16", "3.5", "x", ""}, {"must be a whole number from 0 to 15"}},
           {detect_mesh,
            "--buckets",
            {"0", "-1", "16777217", "9999999999999999999999", "2.5", "x", ""},
            {"must be a whole number from 1 to 16777216"}},
           {detect_mesh, "--cell-size", {"0", "-1", "nan", "inf", "1e300", "1,2,-3"}, {"cell size"}},
           {detect_mesh, "--cell-size", {"x", "1,2"}, {metres}},
           {detect_mesh,
            "--primes",
            {"0,1,2", "2,3", "2,3,5,7", "-2,3,5", "2,3,4294967296", "two,3,5", "2,3,5.0", "2, 3,5"},
            {triple}},
           {detect_mesh, "--threads", {"0", "-1", "257", "x", ""}, {"must be a whole number from 1 to 256"}},
           {detect_mesh, "--repeat", {"0", "-1", "2.5", "x", ""}, {"must be a whole number from 1 to 100000"}},
           {detect_mesh, "--bodies", {"two", "1"}, {": unknown; use one of: objects, components, one"}},
           {detect_mesh, "--method", {"magic"}, {": unknown; use one of: brute-force", "multi-level-sb-exact"}},
           {{"detect", mesh},
            "--tolerance",
            {"0", "-1", "-0.5", "nan", "inf", "1e300", "1e-60", "5e+29", "2e+18", "9e-19", "1e-40"},
            {"1e-18 to 1e18 m"}},
           {{"detect", mesh}, "--tolerance", {"one", "0.1m"}, {": is no number"}, true}})
    for (const std::string& value : values)
      expect_refused(with(command, {option, value}), with(says, {says_value ? option + " = " + value : option}));
  for (const char* option : {"--cell-size", "--primes", "--rest", "--contacts", "--method", "--tolerance"}) {
    expect_refused({"detect", mesh, option, ""}, {option, "the value is empty"});
    expect_refused({"detect", mesh, option}, {option, "missing"});
  }
  expect_refused(with(drop, {"--capture", ""}), {"--capture", "the value is empty"});
}

TEST(Errors, SayInOneLineWhatIsWrongWithTheCommandLine) {
  for (const auto& [arguments, says] : std::vector<std::pair<Words, Words>>{
           {{"simulate", "--scene", "dorp", "--frames", "2"}, {"'dorp'", "drop"}},
           {{"simulate", "--scene", "cube.obj", "--frames", "2"}, {"--scene cube.obj", "--mesh"}},
           {{"simulate", "--tolerence", "0.1"},
            {"--tolerence", "; did you mean --tolerance? See sbcollide simulate --help"}},
           {{"simulate", "--frame=3"}, {"did you mean --frames?"}},
           {{"simulat"}, {"did you mean simulate?"}},
           {{"detect", mesh, "--no-resue", "--tolerance", "1"}, {"did you mean --no-reuse?"}},
           {{"simulate", "--scene", "cube.ply", "--frames", "2"}, {"--scene cube.ply", "--mesh"}},
           {{"--mesh", "none.obj"}, {"--mesh", "none.obj"}},
           {{"simulate", "--scene", "none.toml", "--frames", "2"}, {"none.toml", "cannot be read"}},
           {{"simulate", "--scene", "drop", "--frames", "2", "--no-self=maybe"}, {"--no-self", "without a value"}},
           {{"simulate", "--scene", "drop", "--json=99999999999999999999"}, {"--json", "without a value"}},
           {{"simulate", "--help=99999999999999999999"}, {"--help", "without a value"}},
           {{"simulate", "--scene", "drop", "--frames", "2", "--oracle"}, {"--oracle", "--json-lines"}},
           {with(drop, {"--json-lines"}), {"--json-lines", "--json"}},
           {{"simulate", "--scene", "drop", "--json-lines=3"}, {"--json-lines", "without a value"}},
           {with(detect_mesh, {"--json-lines"}), {"--json-lines"}},
           {with(drop, {"--magic"}), {"--magic"}},
           {{"magic"}, {"magic"}},
           {{"list", "magic"}, {"magic", "scenes"}},
           {with(drop, {"--obj-every", "1", "--out", "/proc/none"}), {"--out /proc/none"}},
           {{"detect", "--tolerance", "1"}, {"FILE"}},
           {{"detect"}, {"required"}},
           {{"detect", mesh}, {"--tolerance: is missing"}},
           {with(detect_mesh, {"--scene", "drop"}), {"--scene"}},
           {with(detect_mesh, {"--method", "all", "--contacts", "/tmp/none.csv"}), {"--contacts", "one method"}},
           {with(detect_mesh, {"--contacts", "--json"}), {"--contacts", "its value is missing"}},
           {with(detect_mesh, {"--rest", "--json"}), {"--rest", "its value is missing"}}})
    expect_refused(arguments, says);
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
  expect_refused(with(drop, {"--capture", "1"}), {"--capture", "graphics"});
  expect_refused(with(drop, {"--animation", "run.webp"}), {"--animation", "graphics"});
}
TEST(Errors, RefuseTheWindowInABuildWithoutGraphics) { expect_refused({}, {"simulate"}); }
#endif

TEST(Errors, NameAFolderThatCannotBeWrittenToEvenIfNothingWouldBe) {
  const TemporaryFolder folder;
  const auto file = folder.write("file", "not a folder");  // a regular file stops even root
  const std::string out = file / "below", contacts = file / "contacts.csv";
  for (const Words& command : {drop,
                               {"report", "detection"},
                               {"report", "contact"},
                               {"report", "solver"},
                               {"report", "stability"},
                               {"report", "theory"}})
    expect_refused(with(command, {"--out", out}), {"--out " + out + ": cannot be written to"});
  for (const Words& detect : {detect_mesh, {"detect", mesh, mesh, "--continuous"}})
    expect_refused(with(detect, {"--contacts", contacts}), {contacts + ": cannot be written"});
}

}  // namespace THIS_FILE
}  // namespace cli::test
