// Checks `list`: it prints a line "KEY<tab>NAME" for each choice.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "tests/cli/process.h"

namespace cli::test {
namespace THIS_FILE {

/// Returns the names by key. Fails the test on a line of another form.
std::map<std::string, std::string> rows(const std::string& what) {
  const Outcome o = run({"list", what});
  EXPECT_EQ(o.status, 0);
  EXPECT_EQ(o.err, "");
  EXPECT_TRUE(o.out.ends_with('\n'));
  std::map<std::string, std::string> names;
  std::istringstream in(o.out);
  for (std::string line; std::getline(in, line);) {
    const auto tab = line.find('\t');
    EXPECT_NE(tab, std::string::npos) << line;
    EXPECT_EQ(line.find('\t', tab + 1), std::string::npos) << line;
    EXPECT_EQ(line.find(' ', 0) < tab, false) << "a key has no space: " << line;
    const std::string name = line.substr(tab + 1);
    EXPECT_FALSE(name.empty()) << line;
    EXPECT_TRUE(names.emplace(line.substr(0, tab), name).second) << "twice: " << line;
  }
  return names;
}

TEST(List, PrintsEachSceneFile) {
  const auto scenes = rows("scenes");
  EXPECT_EQ(scenes.at("drop"), "Drop");
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SBCOLLIDE_SCENES)) {
    if (entry.path().extension() != ".toml") continue;
    EXPECT_TRUE(scenes.contains(entry.path().stem().string())) << entry.path();
    ++files;
  }
  EXPECT_EQ(scenes.size(), files);
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

TEST(List, PrintsTheKeysOfAllMethods) {
  const auto methods = rows("methods");
  for (const char* key :
       {"brute-force", "grid-hash", "bounding-box", "bounding-box-grid-hash", "multi-level-sb", "multi-level-sb-exact"})
    EXPECT_TRUE(methods.contains(key)) << key;
}

TEST(List, PrintsIntegrators) { EXPECT_TRUE(rows("integrators").contains("semi-implicit-euler")); }

TEST(List, PrintsBothContactSurfaces) {
  const auto surfaces = rows("contact-surfaces");
  EXPECT_EQ(surfaces.size(), 2u);
  EXPECT_TRUE(surfaces.contains("vertex-vertex") && surfaces.contains("surface"));
}

TEST(List, PrintsAllListsWithTheirNamesWithoutAWord) {
  const Outcome all = run({"list"});
  EXPECT_EQ(all.status, 0);
  EXPECT_EQ(all.err, "");
  std::string expected;
  for (const std::string name : {"methods", "integrators", "contact-surfaces", "scenes"})
    expected += name + '\n' + run({"list", name}).out;
  EXPECT_EQ(all.out, expected);
}

TEST(List, PrintsOnlyMethodsAndIntegratorsThatRun) {
  for (const auto& [key, name] : rows("methods"))
    EXPECT_EQ(simulate({"--scene", "drop", "--frames", "3", "--method", key})["method"], key);
  for (const auto& [key, name] : rows("integrators"))
    EXPECT_EQ(simulate({"--scene", "drop", "--frames", "3", "--integrator", key})["frames"].size(), 3u);
}

TEST(Help, GoesToStandardOutput) {
  for (const auto& arguments : {std::vector<std::string>{"--help"}, {"simulate", "--help"}}) {
    const Outcome o = run(arguments);
    EXPECT_EQ(o.status, 0);
    EXPECT_EQ(o.err, "");
    EXPECT_NE(o.out.find("--scene"), std::string::npos);
  }
  EXPECT_NE(run({"--version"}).out.find('.'), std::string::npos);
}

}  // namespace THIS_FILE
}  // namespace cli::test
