// Checks the pictures of `simulate --capture`.

#include <gtest/gtest.h>

#include "tests/cli/process.h"

#if SBCOLLIDE_GRAPHICS
#include "tests/load_png.h"

namespace cli::test {
namespace THIS_FILE {

void expect_picture(const std::filesystem::path& file, int width, int height) {
  const engine::Image picture = tests::load_png(file);
  EXPECT_EQ(picture.width, width);
  EXPECT_EQ(picture.height, height);
}

TEST(Capture, WritesEachFrameUnderItsNameAndChangesNothingElse) {
  const TemporaryFolder folder;
  const auto out = folder.path() / "new" / "folder";
  const Words plain{"--scene", "drop", "--frames", "101"};
  const auto document = simulate(with(plain, {"--capture", "100,7", "--size", "203x117", "--out", out}));
  EXPECT_EQ(file_names(out), (std::set<std::string>{"frame_0007.png", "frame_0100.png"}));
  for (const char* name : {"frame_0007.png", "frame_0100.png"}) expect_picture(out / name, 203, 117);
  EXPECT_NE(read_file(out / "frame_0007.png"), read_file(out / "frame_0100.png"));
  EXPECT_EQ(document["state_hash"], simulate(plain)["state_hash"]);
}

TEST(Capture, ShowsTwoWorldsSideBySide) {
  const TemporaryFolder folder;
  const Words plain{"--scene", "drop", "--frames", "60", "--capture", "60", "--out", folder.path()};
  const std::filesystem::path file = folder.path() / "frame_0060.png";
  simulate(with(plain, {"--size", "100x90"}));
  const engine::Image alone = tests::load_png(file);
  simulate(with(plain, {"--size", "201x90", "--beside", "levels=2"}));
  const engine::Image both = tests::load_png(file);
  ASSERT_EQ(both.width, 201);
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 100; ++x)
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(both.at(101 + x, y)[c], alone.at(x, y)[c], 2) << x << ' ' << y;
}

}  // namespace THIS_FILE
}  // namespace cli::test
#endif
