#pragma once
// Pictures in memory and as PNG files. No OpenGL.

#include <cstdint>
#include <filesystem>
#include <glm/vec4.hpp>
#include <stdexcept>
#include <vector>

namespace engine {

/// Rows from the top; 4 bytes per pixel: red, green, blue (sRGB), alpha.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;

  glm::u8vec4 at(int x, int y) const {
    const auto* p =
        rgba.data() + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
    return {p[0], p[1], p[2], p[3]};
  }
};

/// A picture could not be written or read. what() names the path and the reason.
class ImageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes 8-bit RGB (alpha is dropped). The file appears whole or not at all: it is written under a temporary name in
/// the same folder, then renamed. The folder must exist. Throws ImageError.
void save_png(const Image& image, const std::filesystem::path& path);

/// Reads any PNG as RGBA. Throws ImageError.
Image load_png(const std::filesystem::path& path);

}  // namespace engine
