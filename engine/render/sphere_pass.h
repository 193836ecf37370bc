#pragma once
// Draws solid spheres and capsules.

#include <filesystem>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "engine/frame_data.h"
#include "engine/gl.h"
#include "engine/program.h"
#include "engine/render/ambient_occlusion.h"

namespace engine::render {

/// A capsule is drawn as a sphere of which one half is moved along the capsule's axis.
class SpherePass {
 public:
  explicit SpherePass(const std::filesystem::path& shaders);

  /// `occlusion` must be updated for the same frame.
  void update(const FrameData& frame, const AmbientOcclusion& occlusion);
  void draw_shadows(const glm::mat4& light_clip_from_world) const;
  void draw() const;

 private:
  struct Instance {
    glm::vec4 sphere;
    OccluderRange occluders;
    glm::vec3 colour;
    glm::vec3 segment{0.0f};  // axis of a capsule
  };
  void draw_instances() const;

  Program program_, shadow_program_;
  VertexArray array_;
  Buffer directions_, indices_, instance_buffer_;
  std::vector<Instance> instances_;
  GLsizei index_count_ = 0;
};

}  // namespace engine::render
