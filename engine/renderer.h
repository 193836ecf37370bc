#pragma once
// Draws one FrameData: matte bodies and spheres on a light studio floor, with soft shadows, and overlays over them.

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

class Renderer {
 public:
  /// Needs a current context, also when destroyed. Throws ShaderError.
  explicit Renderer(const std::filesystem::path& shaders);
  ~Renderer();

  /// Uploads a mesh: three indices per triangle, counted from its body's first vertex, counter-clockwise from outside.
  /// A mesh with a border is drawn from both sides. Throws std::invalid_argument if an index is out of range.
  MeshHandle add_mesh(std::span<const std::uint32_t> triangles, std::uint32_t vertex_count);

  /// Draws into the bound framebuffer and covers the whole viewport, background included. Does nothing if the viewport
  /// is empty. Throws std::invalid_argument if a draw reaches beyond the vertices or names no mesh.
  void draw(const Camera& camera, const Viewport& viewport, const FrameData& frame);

 private:
  struct Passes;
  std::unique_ptr<Passes> passes_;
};

}  // namespace engine
