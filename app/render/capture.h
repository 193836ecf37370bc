#pragma once
// Pictures of a world without a window.

#include <filesystem>
#include <memory>

#include "softbody/world.h"

namespace app {

class Capture {
 public:
  /// Throws engine::ContextError, engine::ResourceError or engine::ShaderError: one line that says what is missing.
  Capture(int width, int height);
  ~Capture();

  /// Writes what the scene's own camera sees as a PNG of exactly the size asked for. Throws UsageError.
  void write(const softbody::World& world, const std::filesystem::path& file);

 private:
  struct Studio;
  std::unique_ptr<Studio> studio_;
};

}  // namespace app
