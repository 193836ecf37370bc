// `simulate --obj-every`: the motion as OBJ files, which `detect` reads back and finds the same contacts in.

#include <gtest/gtest.h>

#include "tests/cli/process.h"

namespace cli::test {
namespace {

class ObjEvery : public testing::TestWithParam<const char*> {};

TEST_P(ObjEvery, ReadsBackWithTheContactsOfTheSimulation) {
  const TemporaryFolder folder;
  // Both have contacts then: between bodies, and inside a sheet whose quads must come back as such.
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

TEST(ObjEvery, WritesTheBodiesAtRestAgainWhenThereAreOthers) {
  const TemporaryFolder folder;
  const auto scene = folder.write("two.toml", "[[body]]\n[[body]]\nposition = [3, 3, 0]\nappear = 3\n");
  simulate({"--scene", scene.string(), "--frames", "5", "--obj-every", "2", "--out", folder.path().string()});
  EXPECT_EQ(file_names(folder.path()),
            (std::set<std::string>{"frame_0002.obj", "frame_0004.obj", "rest_0002.obj", "rest_0004.obj", "two.toml"}));
}

}  // namespace
}  // namespace cli::test
