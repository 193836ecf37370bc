#pragma once
// Draws pictures of a world without a window.

#include <filesystem>
#include <memory>

#include "softbody/world.h"

namespace app::render {

class Capture {
 public:
  /// Throws engine::ContextError, engine::ResourceError or engine::ShaderError with one line that says what is missing.
  Capture(int width, int height);
  ~Capture();

  /// Writes a PNG of exactly that size, seen by the scene's own camera. Throws UsageError.
  void write(const softbody::World& world, const std::filesystem::path& file);

 private:
  struct Offscreen;
  std::unique_ptr<Offscreen> offscreen_;
};

}  // namespace app::render
