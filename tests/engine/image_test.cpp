#include "engine/image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

namespace engine {
namespace {
namespace fs = std::filesystem;

/// A folder of its own, empty before and gone after.
class ImageFile : public testing::Test {
 protected:
  ImageFile() { fs::create_directories(folder); }
  ~ImageFile() override { fs::remove_all(folder); }

  int files() const {
    return static_cast<int>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  }

  fs::path folder = fs::temp_directory_path() / ("sbcollide_image_" + std::to_string(::getpid()));
};

Image pattern(int width, int height) {
  Image image{width, height, {}};
  for (int i = 0; i < width * height; ++i) {
    for (const int value : {i, 3 * i, 7 * i}) image.rgba.push_back(static_cast<std::uint8_t>(value));
    image.rgba.push_back(255);
  }
  return image;
}

std::string message_of(const auto& action) {
  try {
    action();
  } catch (const ImageError& error) {
    return error.what();
  }
  return "";
}

TEST_F(ImageFile, ComesBackAsItWas) {
  for (const auto& [width, height] : {std::pair{37, 21}, std::pair{1, 1}, std::pair{640, 3}}) {
    const Image image = pattern(width, height);
    save_png(image, folder / "picture.png");
    const Image read = load_png(folder / "picture.png");
    EXPECT_EQ(read.width, width);
    EXPECT_EQ(read.height, height);
    EXPECT_EQ(read.rgba, image.rgba);
  }
  EXPECT_EQ(files(), 1);
}

TEST_F(ImageFile, HasTheRightsOfAnOrdinaryFile) {
  save_png(pattern(2, 2), folder / "picture.png");
  std::ofstream(folder / "other") << "x";
  EXPECT_EQ(fs::status(folder / "picture.png").permissions(), fs::status(folder / "other").permissions());
}

TEST_F(ImageFile, MissingFolderIsNamed) {
  const fs::path path = folder / "nowhere" / "picture.png";
  const std::string message = message_of([&] { save_png(pattern(4, 4), path); });
  EXPECT_NE(message.find(path.string()), std::string::npos) << message;
  EXPECT_NE(message.find("No such file"), std::string::npos) << message;
  EXPECT_FALSE(fs::exists(path.parent_path()));
}

TEST_F(ImageFile, FailureLeavesNothingBehind) {
  // A folder in the picture's place: writing works, the last step does not.
  fs::create_directories(folder / "picture.png");
  const std::string message = message_of([&] { save_png(pattern(4, 4), folder / "picture.png"); });
  EXPECT_NE(message.find("picture.png: Is a directory"), std::string::npos) << message;
  EXPECT_EQ(files(), 1);
}

TEST_F(ImageFile, UnwritableFolderIsNamed) {
  std::ofstream(folder / "file") << "no folder";  // permissions would not stop root
  const std::string message = message_of([&] { save_png(pattern(4, 4), folder / "file" / "picture.png"); });
  EXPECT_NE(message.find("Not a directory"), std::string::npos) << message;
  EXPECT_EQ(files(), 1);
}

TEST_F(ImageFile, EmptyPictureIsRefused) {
  EXPECT_THROW(save_png(Image{}, folder / "picture.png"), ImageError);
  EXPECT_EQ(files(), 0);
}

TEST_F(ImageFile, ReadingNamesTheFile) {
  std::ofstream(folder / "broken.png") << "no picture";
  for (const char* name : {"broken.png", "missing.png"}) {
    const std::string message = message_of([&] { load_png(folder / name); });
    EXPECT_NE(message.find(name), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace engine
