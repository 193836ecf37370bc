#include "engine/image.h"

#include <png.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>

namespace engine {
namespace fs = std::filesystem;

namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

[[noreturn]] void fail(const char* what, const fs::path& path, const std::string& reason) {
  throw ImageError(std::string("cannot ") + what + " " + path.string() + ": " + reason);
}

/// A new file beside `path`, which must not exist yet; its name is put into `name`.
File open_temporary(const fs::path& path, std::string& name) {
  name = path.string() + ".XXXXXX";
  const int descriptor = ::mkstemp(name.data());
  if (descriptor < 0) fail("write", path, std::strerror(errno));
  // mkstemp makes it private; a picture gets the rights of any other new file.
  const mode_t mask = ::umask(0);
  ::umask(mask);
  ::fchmod(descriptor, 0666 & ~mask);
  return {::fdopen(descriptor, "wb"), &std::fclose};
}

/// libpng's simplified interface reports by return value, without longjmp.
std::string encode(const Image& image, std::FILE* file) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> rgb;
  rgb.reserve(image.rgba.size() / 4 * 3);
  for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4) {
    rgb.insert(rgb.end(), {image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]});
  }
  return png_image_write_to_stdio(&png, file, 0, rgb.data(), 0, nullptr) ? "" : png.message;
}

}  // namespace

void save_png(const Image& image, const fs::path& path) {
  const auto pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (image.width < 1 || image.height < 1 || image.rgba.size() != 4 * pixels) fail("write", path, "empty picture");
  std::string temporary;
  File file = open_temporary(path, temporary);
  std::string problem = encode(image, file.get());
  // A full disk may show only when the file is closed.
  if (std::fclose(file.release()) != 0 && problem.empty()) problem = std::strerror(errno);
  if (problem.empty() && std::rename(temporary.c_str(), path.c_str()) != 0) problem = std::strerror(errno);
  if (!problem.empty()) {
    std::remove(temporary.c_str());
    fail("write", path, problem);
  }
}

Image load_png(const fs::path& path) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&png, path.c_str())) fail("read", path, png.message);
  png.format = PNG_FORMAT_RGBA;
  Image image{static_cast<int>(png.width), static_cast<int>(png.height),
              std::vector<std::uint8_t>(PNG_IMAGE_SIZE(png))};
  if (!png_image_finish_read(&png, nullptr, image.rgba.data(), 0, nullptr)) fail("read", path, png.message);
  return image;
}

}  // namespace engine
