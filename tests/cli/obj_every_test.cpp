// Checks `simulate --obj-every`: `detect` finds the same contacts in its OBJ files.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "tests/cli/process.h"

namespace cli::test {
namespace THIS_FILE {

/// Returns the contacts and the self-contacts of a frame of `simulate`, as `detect` counts them.
std::pair<std::uint64_t, std::uint64_t> counted(const nlohmann::json& frame) {
  const auto self = frame["contacts"]["self"].get<std::uint64_t>();
  return {self + frame["contacts"]["bodies"].get<std::uint64_t>(), self};
}

/// The scenes have contacts by then: between bodies, and inside a sheet whose quads must be read back as quads.
TEST(ObjEvery, ReadsBackWithTheContactsOfTheSimulation) {
  for (const char* scene : {"B", "cloth"}) {
    SCOPED_TRACE(scene);
    const TemporaryFolder folder;
    const Words tolerance{"--tolerance", "0.07"};
    const nlohmann::json run =
        simulate(with(tolerance, {"--scene", scene, "--frames", "60", "--obj-every", "20", "--out", folder.path()}));
    ASSERT_EQ(file_names(folder.path()), (std::set<std::string>{"frame_0020.obj", "frame_0040.obj", "frame_0060.obj",
                                                                "rest_0020.obj", "scene.toml"}));
    Words files{"--rest", folder.path() / "rest_0020.obj"};
    for (const char* frame : {"frame_0020.obj", "frame_0040.obj", "frame_0060.obj"})
      files.push_back(folder.path() / frame);
    const nlohmann::json found = detect(with(tolerance, files));
    ASSERT_EQ(found["frames"].size(), 3u);
    std::uint64_t all = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [contacts, self] = counted(run["frames"][20 * i + 19]);
      EXPECT_EQ(found["frames"][i]["contacts"], contacts);
      EXPECT_EQ(found["frames"][i]["self_contacts"], self);
      all += contacts;
    }
    EXPECT_GT(all, 0u);
  }
}

/// Gas inflates these bodies: at rest they are larger than their mesh.
TEST(ObjEvery, ReadsBackWithTheCellSizeOfTheSimulation) {
  const TemporaryFolder folder;
  const Words options{"--method", "multi-level-sb", "--tolerance", "0.1"};
  const nlohmann::json run =
      simulate(with(options, {"--scene", "drop", "--frames", "120", "--out", folder.path(), "--obj-every", "120"}));
  const nlohmann::json found =
      detect(with(options, {folder.path() / "frame_0120.obj", "--rest", folder.path() / "rest_0120.obj"}));
  EXPECT_NEAR(found["cell_size"][0], 0.6175, 1e-3);
  EXPECT_EQ(found["frames"][0]["contacts"], counted(run["frames"][119]).first);
}

TEST(ObjEvery, LeavesOutFramesThatNoFileCanHold) {
  const TemporaryFolder folder;
  const Outcome o = run({"simulate", "--scene", "A", "--frames", "20", "--substeps", "1", "--integrator",
                         "semi-implicit-euler", "--json", "--obj-every", "1", "--out", folder.path()});
  ASSERT_EQ(o.status, 0) << o.err;
  const auto d = nlohmann::json::parse(o.out);
  int left_out = 0;
  for (const nlohmann::json& f : d["frames"]) {
    if (f["finite"] == true) continue;
    ++left_out;
    const auto file = folder.path() / fmt::format("frame_{:04}.obj", f["frame"].get<int>());
    EXPECT_FALSE(std::filesystem::exists(file)) << file;
    for (const char* key : {"energy", "deepest_penetration", "max_speed"}) EXPECT_TRUE(f[key].is_null()) << key;
    EXPECT_TRUE(f["volume_ratio"]["min"].is_null());
  }
  ASSERT_GT(left_out, 0) << "it blows up";
  ASSERT_EQ(d["warnings"].size(), 2u) << d["warnings"];
  std::string said;
  for (const nlohmann::json& warning : d["warnings"]) said += "warning: " + warning.get<std::string>() + '\n';
  EXPECT_EQ(o.err, said);
  EXPECT_NE(said.find("Body 0 gained energy from nowhere"), std::string::npos) << said;
  EXPECT_NE(said.find("is not written"), std::string::npos) << said;
  // A table has every 20th frame only, and the warning names the same frame.
  const Outcome table =
      run({"simulate", "--scene", "A", "--frames", "400", "--substeps", "1", "--integrator", "semi-implicit-euler"});
  EXPECT_NE(table.err.find(said.substr(0, said.find('\n'))), std::string::npos) << table.err;
}

TEST(ObjEvery, WritesTheBodiesAtRestWhenTheyChange) {
  const TemporaryFolder folder;
  const auto scene = folder.write("two.toml", "[[body]]\n[[body]]\nposition = [3, 3, 0]\nappear = 3\n");
  simulate({"--scene", scene.string(), "--frames", "5", "--obj-every", "2", "--out", folder.path().string()});
  EXPECT_EQ(file_names(folder.path()), (std::set<std::string>{"frame_0002.obj", "frame_0004.obj", "rest_0002.obj",
                                                              "rest_0004.obj", "scene.toml", "two.toml"}));
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

TEST(ObjEvery, ReplacesOnlyASceneThatARecordingWrote) {
  const TemporaryFolder folder;
  const Words record{"simulate", "--frames", "1", "--obj-every", "1", "--out", folder.path(), "--scene"};
  for (const double tolerance : {0.04, 0.05}) {
    ASSERT_EQ(run(with(record, {"A", "--tolerance", std::to_string(tolerance)})).status, 0);
    EXPECT_NE(read_file(folder.path() / "scene.toml").find(fmt::format("tolerance = {}", tolerance)),
              std::string::npos);
  }
  const std::string mine = "[[body]]\n";
  const auto scene = folder.write("scene.toml", mine);
  for (const std::string& of : {std::string("A"), scene.string()})
    expect_refused(with(record, {of}), {"scene.toml", "name another file or folder"});
  EXPECT_EQ(read_file(scene), mine);
}

}  // namespace THIS_FILE
}  // namespace cli::test
