#pragma once
// Draws pictures of a world without a window.

#include <memory>

#include "engine/image.h"
#include "softbody/world/bodies_in_motion.h"

namespace app::render {

class Capture {
 public:
  /// Throws engine::ContextError, engine::ResourceError or engine::ShaderError with one line that says what is missing.
  Capture(int width, int height);
  ~Capture();

  /// Returns a picture of exactly that size, seen by the scene's own camera.
  engine::Image draw(const softbody::BodiesInMotion& world);

 private:
  struct Offscreen;
  std::unique_ptr<Offscreen> offscreen_;
};

}  // namespace app::render
