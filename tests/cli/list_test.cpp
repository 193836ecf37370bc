// Checks `list`: it prints a line "KEY<tab>NAME" for each choice; and what --help and --version print.

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "collide/methods.h"
#include "sbcollide/version.h"
#include "softbody/integrate/integrators.h"
#include "softbody/scene/scene.h"
#include "tests/cli/process.h"

namespace cli::test {
namespace THIS_FILE {

/// Returns what a command prints, which must succeed.
std::string printed(const Words& arguments) {
  const Outcome o = run(arguments);
  EXPECT_EQ(o.status, 0);
  EXPECT_EQ(o.err, "");
  return o.out;
}

std::string lines_of(const auto& table) {
  std::string lines;
  for (const auto& row : table) lines.append(row.key).append("\t").append(row.name).append("\n");
  return lines;
}

TEST(List, PrintsEachSceneFile) {
  const std::string scenes = printed({"list", "scenes"});
  EXPECT_NE(("\n" + scenes).find("\ndrop\tDrop\n"), std::string::npos) << scenes;
  std::ptrdiff_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SBCOLLIDE_SCENES)) {
    if (entry.path().extension() != ".toml") continue;
    EXPECT_NE(("\n" + scenes).find("\n" + entry.path().stem().string() + "\t"), std::string::npos) << entry.path();
    ++files;
  }
  EXPECT_EQ(std::ranges::count(scenes, '\n'), files);
}

TEST(List, NamesABrokenSceneFileAndPrintsTheOthers) {
  const TemporaryFolder folder;
  const auto scenes = folder.path() / "assets" / "scenes";
  std::filesystem::create_directories(scenes);
  for (const char* name : {"assets/scenes/a.toml", "assets/scenes/c.toml"})
    folder.write(name, "name = \"A scene\"\n[[body]]\n");
  const auto broken = folder.write("assets/scenes/b.toml", "[[body]\n");
  const Outcome o = run({"list", "scenes"}, "/", {"SBCOLLIDE_DATA=" + folder.path().string()});
  EXPECT_EQ(o.status, 2);
  EXPECT_EQ(o.out, "a\tA scene\nc\tA scene\n");
  EXPECT_EQ(o.err.find("sbcollide: " + broken.string() + ":1: "), 0u) << o.err;
  EXPECT_EQ(std::ranges::count(o.err, '\n'), 1) << o.err;
}

TEST(List, PrintsAllTablesWithTheirNamesWithoutAWord) {
  std::string expected;
  for (const auto& [name, lines] : {std::pair("methods", lines_of(collide::method_table())),
                                    {"integrators", lines_of(softbody::integrators())},
                                    {"contact-surfaces", lines_of(softbody::contact_surfaces)}}) {
    EXPECT_EQ(printed({"list", name}), lines);
    expected.append(name).append("\n").append(lines);
  }
  EXPECT_EQ(printed({"list"}), expected + "scenes\n" + printed({"list", "scenes"}));
}

TEST(Help, GoesToStandardOutput) {
  for (const Words& arguments : {Words{"--help"}, {"simulate", "--help"}})
    EXPECT_NE(printed(arguments).find("--scene"), std::string::npos);
}

TEST(Version, StandsAloneInItsLineAboveWhatAReportOfAFaultNeeds) {
  const std::string text = printed({"--version"}), first = SBCOLLIDE_VERSION "\n";
  ASSERT_TRUE(text.starts_with(first)) << text;
  const std::regex below(
      "instruction set: [A-Z0-9_]+\ncompiler: [A-Za-z]+ [0-9.]+.*\nlibraries: [A-Za-z0-9_]+ [0-9.]+(, [A-Za-z0-9_]+ "
      "[0-9.]+)+\n");
  EXPECT_TRUE(std::regex_match(text.substr(first.size()), below)) << text;
}

}  // namespace THIS_FILE
}  // namespace cli::test
