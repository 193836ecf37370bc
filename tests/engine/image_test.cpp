#include "engine/image.h"

#include <gtest/gtest.h>

#include "tests/load_png.h"
#include "tests/temporary_folder.h"

namespace engine {
namespace THIS_FILE {

Image test_picture(int width, int height) {
  Image image{width, height, {}};
  for (int i = 0; i < width * height; ++i) {
    for (const int value : {i, 3 * i, 7 * i}) image.rgba.push_back(static_cast<std::uint8_t>(value));
    image.rgba.push_back(255);
  }
  return image;
}

TEST(EncodePng, KeepsAllPixels) {
  const tests::TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{37, 21}, std::pair{1, 1}, std::pair{640, 3}}) {
    const Image image = test_picture(width, height);
    const Image read = tests::load_png(folder.write("picture.png", encode_png(image)));
    EXPECT_EQ(read.width, width);
    EXPECT_EQ(read.height, height);
    EXPECT_EQ(read.rgba, image.rgba);
  }
}

TEST(EncodePng, RefusesEmptyPictures) {
  EXPECT_THROW(encode_png(Image{}), ImageError);
  EXPECT_THROW(encode_png(Image{2, 2, {}}), ImageError);
}

}  // namespace THIS_FILE
}  // namespace engine
