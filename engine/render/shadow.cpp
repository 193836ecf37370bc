#include "engine/render/shadow.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace engine {

glm::mat4 LightView::texture_from_world() const {
  const glm::mat4 half = glm::scale(glm::mat4(1.0f), glm::vec3(0.5f));
  return glm::translate(glm::mat4(1.0f), glm::vec3(0.5f)) * half * clip_from_world;
}

glm::vec4 LightView::reach_of(std::span<const glm::vec4> spheres) const {
  const glm::mat4 from_world = texture_from_world();
  glm::vec2 least(1.0f), greatest(0.0f);
  for (const glm::vec4& sphere : spheres) {
    const glm::vec2 middle(from_world * glm::vec4(glm::vec3(sphere), 1.0f));
    const float margin = (sphere.w / texel + 8.0f) / static_cast<float>(ShadowMap::size);
    least = glm::min(least, middle - margin);
    greatest = glm::max(greatest, middle + margin);
  }
  return {least, greatest};
}

ShadowMap::ShadowMap() {
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  framebuffer_ = GlName<detail::delete_framebuffer>(name);
  depth_.bind(0, GL_TEXTURE_2D);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT16, size, size, 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.id(), 0);
  glDrawBuffer(GL_NONE);
  glReadBuffer(GL_NONE);
}

LightView ShadowMap::view(const glm::vec3& to_light, const glm::vec3& centre, float radius) const {
  // A border of a few texels keeps the filter inside the map.
  const float half = radius * (1.0f + 16.0f / static_cast<float>(size));
  const float texel = 2.0f * half / static_cast<float>(size);
  const glm::mat4 turn = glm::lookAt(glm::vec3(0.0f), -to_light, glm::vec3(0.0f, 1.0f, 0.0f));
  // Moved by whole texels alone: shadows keep still while the bounds move.
  glm::vec3 middle = glm::vec3(turn * glm::vec4(centre, 1.0f));
  middle.x = texel * std::round(middle.x / texel);
  middle.y = texel * std::round(middle.y / texel);
  const glm::mat4 projection = glm::ortho(middle.x - half, middle.x + half, middle.y - half, middle.y + half,
                                          -middle.z - 2.0f * half, -middle.z + 2.0f * half);
  return {projection * turn, texel};
}

void ShadowMap::begin() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
  glViewport(0, 0, size, size);
  glClear(GL_DEPTH_BUFFER_BIT);
  // The outermost texels stay empty: beyond the map, where they are repeated, everything is lit.
  glEnable(GL_SCISSOR_TEST);
  glScissor(1, 1, size - 2, size - 2);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1.5f, 2.0f);
}

void ShadowMap::end() const {
  glDisable(GL_POLYGON_OFFSET_FILL);
  glDisable(GL_SCISSOR_TEST);
}

}  // namespace engine
