#pragma once
// Draws one FrameData: matte bodies and solids in a light studio with soft shadows, and overlays on top.

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <memory>
#include <span>

#include "engine/camera.h"
#include "engine/frame_data.h"

namespace engine {

/// The part of the bound framebuffer to draw into, in pixels from OpenGL's bottom left corner.
struct Viewport {
  glm::ivec2 origin{0};
  glm::ivec2 size{0};
};

namespace render {

class Renderer {
 public:
  /// Reads the shaders in the folder `shaders`. Needs a current context, also when destroyed. Throws ShaderError.
  explicit Renderer(const std::filesystem::path& shaders);
  ~Renderer();

  /// Uploads a mesh: three indices per triangle, counted from the body's first vertex, counter-clockwise from outside.
  /// Both sides of an open mesh are drawn. Throws std::invalid_argument if an index is not below `vertex_count` or the
  /// last triangle is incomplete.
  MeshHandle add_mesh(std::span<const std::uint32_t> triangles, std::uint32_t vertex_count);

  /// Draws into the bound framebuffer, which has depth and stencil, and covers the whole viewport, background included.
  /// Does nothing if the viewport is empty. Throws std::invalid_argument if a draw exceeds the vertices of the frame or
  /// does not fit its mesh.
  void draw(const Camera& camera, const Viewport& viewport, const FrameData& frame);

 private:
  struct Passes;
  std::unique_ptr<Passes> passes_;
};

}  // namespace render
}  // namespace engine
