#pragma once
// The shadow map: the scene's depth as the light sees it.

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "engine/gl.h"

namespace engine {

/// An orthographic view along the light that just holds a sphere.
struct LightView {
  glm::mat4 clip_from_world;  // of the light
  glm::mat4 texture_from_world() const;
  /// The part of the map that the shadows of what is in these spheres can fall on: least and greatest x, y.
  glm::vec4 reach_of(std::span<const glm::vec4> spheres) const;
  float texel;  // m
};

class ShadowMap {
 public:
  static constexpr int size = 512;

  ShadowMap();
  LightView view(const glm::vec3& to_light, const glm::vec3& centre, float radius) const;
  void begin() const;  // clears it and makes it the target of what is drawn until the caller binds another
  void end() const;
  const Texture& texture() const { return depth_; }

 private:
  Texture depth_;
  GlName<detail::delete_framebuffer> framebuffer_;
};

}  // namespace engine
