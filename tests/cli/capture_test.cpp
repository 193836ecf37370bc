// Checks the pictures of `simulate --capture`.

#include <gtest/gtest.h>

#include "tests/cli/process.h"

#if SBCOLLIDE_GRAPHICS
namespace cli::test {
namespace THIS_FILE {

/// The header chunk of a PNG file.
struct Png {
  bool whole;  // starts and ends as a PNG does
  unsigned width, height, depth, colour;
};

Png png(const std::filesystem::path& file) {
  const std::string bytes = read_file(file);
  if (bytes.size() < 57) return {};
  const auto number = [&](std::size_t at) {
    unsigned value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
  };
  const bool whole = bytes.starts_with("\x89PNG\r\n\x1a\n") && bytes.substr(12, 4) == "IHDR" &&
                     bytes.substr(bytes.size() - 8, 4) == "IEND";
  return {whole, number(16), number(20), static_cast<unsigned char>(bytes[24]), static_cast<unsigned char>(bytes[25])};
}

void expect_picture(const std::filesystem::path& file, unsigned width, unsigned height) {
  const Png p = png(file);
  EXPECT_TRUE(p.whole) << file;
  EXPECT_EQ(p.width, width);
  EXPECT_EQ(p.height, height);
  EXPECT_EQ(p.depth, 8u);
  EXPECT_TRUE(p.colour == 2 || p.colour == 6) << "RGB or RGBA";
}

TEST(Capture, WritesEachFrameUnderItsNameAndNothingElse) {
  const TemporaryFolder folder;
  const auto out = folder.path() / "new" / "folder";
  const auto document =
      simulate({"--scene", "drop", "--frames", "101", "--capture", "100,7", "--size", "203x117", "--out", out});
  EXPECT_EQ(document["frames"].size(), 101u);
  EXPECT_EQ(file_names(out), (std::set<std::string>{"frame_0007.png", "frame_0100.png"}));
  for (const char* name : {"frame_0007.png", "frame_0100.png"}) expect_picture(out / name, 203, 117);
  EXPECT_NE(read_file(out / "frame_0007.png"), read_file(out / "frame_0100.png"));
}

TEST(Capture, DoesNotChangeTheSimulation) {
  const TemporaryFolder folder;
  const std::vector<std::string> plain{"--scene", "drop", "--frames", "20"};
  auto with = plain;
  with.insert(with.end(), {"--capture", "5,20", "--size", "64x48", "--out", folder.path()});
  EXPECT_EQ(simulate(with)["state_hash"], simulate(plain)["state_hash"]);
}

TEST(Capture, WritesToTheWorkingDirectoryAndReplacesOldPictures) {
  const TemporaryFolder folder;
  folder.write("frame_0002.png", "an old one");
  const Outcome o =
      run({"simulate", "--scene", "drop", "--frames", "2", "--capture", "2", "--size", "33x44"}, folder.path());
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(o.err, "");
  EXPECT_EQ(file_names(folder.path()), std::set<std::string>{"frame_0002.png"});
  expect_picture(folder.path() / "frame_0002.png", 33, 44);
}

}  // namespace THIS_FILE
}  // namespace cli::test
#endif
