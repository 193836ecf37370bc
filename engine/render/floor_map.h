#pragma once
// Ambient occlusion of the floor, as a texture.

#include <filesystem>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "engine/frame_data.h"
#include "engine/gl.h"
#include "engine/program.h"
#include "engine/render/ambient_occlusion.h"

namespace engine::render {

/// A map of the floor, seen from above: the light of the sky that reaches each point, multiplied over all spheres.
class FloorMap {
 public:
  static constexpr int size = 512;  // texels

  explicit FloorMap(const std::filesystem::path& shaders);
  /// Draws the map of a frame that has a floor. The uniform block "Frame" and `occlusion` must be updated for this
  /// frame. Leaves the map's framebuffer bound.
  void draw(const FrameData& frame, const AmbientOcclusion& occlusion);

 private:
  struct Instance {
    glm::vec4 sphere;
    glm::vec3 colour;
  };
  Program program_;
  VertexArray array_;
  Buffer instance_buffer_;
  Texture map_;
  FramebufferName framebuffer_;
  std::vector<Instance> instances_;
};

}  // namespace engine::render
