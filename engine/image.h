#pragma once
// Pictures in memory and as PNG. No OpenGL.

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace engine {

/// Rows from the top; 4 bytes per pixel: red, green, blue (sRGB), alpha.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;

  /// Returns the pixel in column `x` and row `y`, which must be inside the picture.
  glm::u8vec4 at(int x, int y) const {
    assert(x >= 0 && x < width && y >= 0 && y < height);
    const auto* p =
        rgba.data() + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
    return {p[0], p[1], p[2], p[3]};
  }
};

/// A picture cannot be encoded. what() is the reason.
struct ImageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Returns the bytes of an 8-bit RGB PNG file; drops alpha. Throws ImageError, also if the picture is empty.
std::string encode_png(const Image& image);

}  // namespace engine
