#pragma once
// Draws solids with flat faces: oriented boxes and planes.

#include <cstddef>
#include <filesystem>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <vector>

#include "engine/frame_data.h"
#include "engine/gl.h"
#include "engine/program.h"

namespace engine::render {

/// A plane is drawn as one face of a box: a square patch near the scene.
class BoxPass {
 public:
  explicit BoxPass(const std::filesystem::path& shaders);

  void update(const FrameData& frame);
  void draw_shadows(const glm::mat4& light_clip_from_world) const;  // planes cast none
  void draw() const;

 private:
  struct Instance {
    glm::vec3 centre;
    glm::mat3 half_axes;
    glm::vec3 colour;
  };
  /// Draws `count` instances from `first` on, each with `vertices` vertices of the cube from `begin` on.
  void draw_instances(std::size_t first, std::size_t count, GLint begin, GLsizei vertices) const;

  Program box_program_, shadow_program_, plane_program_;
  VertexArray array_;
  Buffer instance_buffer_;
  std::vector<Instance> instances_;  // the boxes, then the planes
  std::size_t box_count_ = 0;
};

}  // namespace engine::render
