#pragma once

#include <glm/vec2.hpp>

namespace engine {

/// The part of the bound framebuffer to draw into, in pixels from OpenGL's bottom left corner.
struct Viewport {
  glm::ivec2 origin{0};
  glm::ivec2 size{0};
};

}  // namespace engine
