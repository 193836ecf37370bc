#pragma once
// Solid spheres and capsules, and what spheres and bodies keep from the floor.

#include <glm/mat4x4.hpp>
#include <vector>

#include "engine/frame_data.h"
#include "engine/gl.h"
#include "engine/render/occlusion.h"

namespace engine {

/// A capsule is drawn as a sphere whose one half is moved along a segment.
class Spheres {
 public:
  explicit Spheres(const std::filesystem::path& shaders);

  void update(const FrameData& frame, const Occlusion& occlusion);
  void draw_shadows(const glm::mat4& light_clip) const;
  void draw() const;

 private:
  struct Instance {
    glm::vec4 sphere;
    Range occluders;
    glm::vec3 colour;
    glm::vec3 segment{0.0f};
  };
  void draw_instances() const;

  Program program_, shadow_program_;
  VertexArray array_;
  Buffer directions_, indices_, instance_buffer_;
  std::vector<Instance> instances_;
  GLsizei index_count_ = 0;
};

/// A map of the floor, seen from above: how much light of the sky reaches each place, multiplied over all spheres.
class FloorMap {
 public:
  static constexpr int size = 512;

  explicit FloorMap(const std::filesystem::path& shaders);
  /// Draws the map; leaves its framebuffer bound. The uniform block must be up to date.
  void draw(const FrameData& frame, const Occlusion& occlusion);

 private:
  struct Instance {
    glm::vec4 sphere;
    glm::vec3 colour;
  };
  Program program_;
  VertexArray array_;
  Buffer instance_buffer_;
  Texture map_;
  GlName<detail::delete_framebuffer> framebuffer_;
  std::vector<Instance> instances_;
};

}  // namespace engine
