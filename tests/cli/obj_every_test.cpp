// Checks `simulate --obj-every`: `detect` finds the same contacts in its OBJ files.

#include <gtest/gtest.h>

#include "tests/cli/process.h"

namespace cli::test {
namespace {

class ObjEvery : public testing::TestWithParam<const char*> {};

TEST_P(ObjEvery, ReadsBackWithTheContactsOfTheSimulation) {
  const TemporaryFolder folder;
  // Both scenes have contacts by then: between bodies, and inside a sheet whose quads must be read back as quads.
  const nlohmann::json run = simulate({"--scene", GetParam(), "--frames", "60", "--obj-every", "20", "--tolerance",
                                       "0.07", "--out", folder.path().string()});
  ASSERT_EQ(file_names(folder.path()),
            (std::set<std::string>{"frame_0020.obj", "frame_0040.obj", "frame_0060.obj", "rest_0020.obj"}));
  std::vector<std::string> arguments;
  for (const char* frame : {"20", "40", "60"})
    arguments.push_back((folder.path() / ("frame_00" + std::string(frame) + ".obj")).string());
  arguments.insert(arguments.end(), {"--tolerance", "0.07", "--rest", (folder.path() / "rest_0020.obj").string()});
  const nlohmann::json found = detect(arguments);
  ASSERT_EQ(found["frames"].size(), 3u);
  std::uint64_t all = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const nlohmann::json& expected = run["frames"][20 * i + 19]["contacts"];
    const auto self = expected["self"].get<std::uint64_t>(), bodies = expected["bodies"].get<std::uint64_t>();
    EXPECT_EQ(found["frames"][i]["contacts"], self + bodies);
    EXPECT_EQ(found["frames"][i]["self_contacts"], self);
    all += self + bodies;
  }
  EXPECT_GT(all, 0u);
}

INSTANTIATE_TEST_SUITE_P(Scenes, ObjEvery, testing::Values("B", "cloth"),
                         [](const auto& scene) { return scene.param; });

TEST(ObjEvery, WritesTheBodiesAtRestWhenTheyChange) {
  const TemporaryFolder folder;
  const auto scene = folder.write("two.toml", "[[body]]\n[[body]]\nposition = [3, 3, 0]\nappear = 3\n");
  simulate({"--scene", scene.string(), "--frames", "5", "--obj-every", "2", "--out", folder.path().string()});
  EXPECT_EQ(file_names(folder.path()),
            (std::set<std::string>{"frame_0002.obj", "frame_0004.obj", "rest_0002.obj", "rest_0004.obj", "two.toml"}));
}

TEST(ObjEvery, NeverReplacesTheSceneOrItsMeshes) {
  const TemporaryFolder folder;
  const std::string tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  for (const char* mesh : {"frame_0004.obj", "rest_0002.obj"}) {
    folder.write(mesh, tetrahedron);
    const auto scene = folder.write(
        "scene.toml", "[[body]]\nmesh = {kind = \"file\", path = \"" + std::string(mesh) + "\", size = 1}\n");
    const auto before = file_names(folder.path());
    expect_refused({"simulate", "--scene", scene, "--frames", "4", "--obj-every", "2", "--out", folder.path()},
                   {mesh, "is the input"});
    EXPECT_EQ(file_names(folder.path()), before) << "refused before anything was written";
    EXPECT_EQ(read_file(folder.path() / mesh), tetrahedron);
    std::filesystem::remove(folder.path() / mesh);
  }
  const auto scene = folder.write("scene.toml", "[[body]]\n");
  std::filesystem::create_symlink("scene.toml", folder.path() / "frame_0002.obj");
  expect_refused({"simulate", "--scene", scene, "--frames", "2", "--obj-every", "2", "--out", folder.path()},
                 {"frame_0002.obj", "is the input " + scene.string()});
}

}  // namespace
}  // namespace cli::test
