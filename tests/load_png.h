#pragma once
// Reads pictures that the program has written.

#include <gtest/gtest.h>
#include <png.h>

#include <filesystem>

#include "engine/image.h"

namespace tests {

/// Returns a PNG file as RGBA. If it cannot be read, the test fails and gets an empty picture.
inline engine::Image load_png(const std::filesystem::path& path) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  const bool opened = png_image_begin_read_from_file(&png, path.c_str());
  EXPECT_TRUE(opened) << path << ": " << static_cast<const char*>(png.message);
  if (!opened) return {};
  png.format = PNG_FORMAT_RGBA;
  engine::Image image{static_cast<int>(png.width), static_cast<int>(png.height),
                      std::vector<std::uint8_t>(PNG_IMAGE_SIZE(png))};
  EXPECT_TRUE(png_image_finish_read(&png, nullptr, image.rgba.data(), 0, nullptr)) << path;
  return image;
}

}  // namespace tests
