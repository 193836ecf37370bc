#pragma once
// Solids with flat faces: boxes, and patches of planes.

#include <glm/mat4x4.hpp>
#include <vector>

#include "engine/frame_data.h"
#include "engine/gl.h"

namespace engine {

class Blocks {
 public:
  explicit Blocks(const std::filesystem::path& shaders);

  void update(const FrameData& frame);
  void draw_shadows(const glm::mat4& light_clip) const;  // planes cast none
  void draw() const;

 private:
  struct Instance {
    glm::vec3 centre;
    glm::mat3 half_axes;
    glm::vec3 colour;
  };
  /// The instances from `first` on, `vertices` of the cube each.
  void draw_instances(std::size_t first, std::size_t count, GLsizei vertices) const;

  Program block_, block_shadow_, plane_;
  VertexArray array_;
  Buffer corners_, instance_buffer_;
  std::vector<Instance> instances_;  // the blocks, then the planes
  std::size_t blocks_ = 0;
};

}  // namespace engine
