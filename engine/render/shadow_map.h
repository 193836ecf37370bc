#pragma once
// The shadow map: the depth of the scene as seen from the light.

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "engine/gl.h"

namespace engine::render {

/// An orthographic view along the light.
struct LightView {
  glm::mat4 clip_from_world;
  float texel_size;  // of the shadow map, m

  /// World to 0..1 in the shadow map, depth included.
  glm::mat4 texture_from_world() const;
  /// Returns the part of the shadow map that can hold shadows of `spheres` (centre, radius): min x, min y, max x, max
  /// y.
  glm::vec4 shadow_bounds(std::span<const glm::vec4> spheres) const;
};

class ShadowMap {
 public:
  static constexpr int size = 512;  // texels

  ShadowMap();
  /// Returns the light's view of the sphere round `centre` (radius > 0, m). `to_light` has length 1.
  LightView light_view(const glm::vec3& to_light, const glm::vec3& centre, float radius) const;
  /// Clears the map and binds it as the framebuffer. What is drawn until end() goes into the map.
  void begin() const;
  /// Restores the state that begin() changed, except the framebuffer binding.
  void end() const;
  const Texture& texture() const { return depth_; }

 private:
  Texture depth_;
  FramebufferName framebuffer_;
};

}  // namespace engine::render
