#include "engine/render/shadow_map.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace engine::render {

glm::mat4 LightView::texture_from_world() const {
  const glm::mat4 half = glm::scale(glm::mat4(1.0f), glm::vec3(0.5f));
  return glm::translate(glm::mat4(1.0f), glm::vec3(0.5f)) * half * clip_from_world;
}

glm::vec4 LightView::shadow_bounds(std::span<const glm::vec4> spheres) const {
  const glm::mat4 from_world = texture_from_world();
  glm::vec2 min(1.0f), max(0.0f);
  for (const glm::vec4& sphere : spheres) {
    const glm::vec2 centre(from_world * glm::vec4(glm::vec3(sphere), 1.0f));
    const float margin = (sphere.w / texel_size + 8.0f) / static_cast<float>(ShadowMap::size);
    min = glm::min(min, centre - margin);
    max = glm::max(max, centre + margin);
  }
  return {min, max};
}

ShadowMap::ShadowMap() : framebuffer_(generated(glGenFramebuffers)) {
  depth_.bind(0, GL_TEXTURE_2D);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT16, size, size, 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT, nullptr);
  set_linear_clamped();
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.id(), 0);
  constexpr GLenum none = GL_NONE;
  glDrawBuffers(1, &none);
  glReadBuffer(GL_NONE);
}

LightView ShadowMap::light_view(const glm::vec3& to_light, const glm::vec3& centre, float radius) const {
  // A border of a few texels keeps the filter inside the map.
  const float half = radius * (1.0f + 16.0f / static_cast<float>(size));
  const float texel_size = 2.0f * half / static_cast<float>(size);
  const glm::mat4 rotation = glm::lookAt(glm::vec3(0.0f), -to_light, glm::vec3(0.0f, 1.0f, 0.0f));
  // The view moves by whole texels only, so that shadows stay still while the bounds move.
  glm::vec3 middle = glm::vec3(rotation * glm::vec4(centre, 1.0f));
  middle.x = texel_size * std::round(middle.x / texel_size);
  middle.y = texel_size * std::round(middle.y / texel_size);
  const glm::mat4 projection = glm::ortho(middle.x - half, middle.x + half, middle.y - half, middle.y + half,
                                          -middle.z - 2.0f * half, -middle.z + 2.0f * half);
  return {projection * rotation, texel_size};
}

void ShadowMap::begin() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
  glViewport(0, 0, size, size);
  glClear(GL_DEPTH_BUFFER_BIT);
  // The outermost texels stay empty. They are repeated beyond the map, so everything there is lit.
  glEnable(GL_SCISSOR_TEST);
  glScissor(1, 1, size - 2, size - 2);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1.5f, 2.0f);
}

void ShadowMap::end() const {
  glDisable(GL_POLYGON_OFFSET_FILL);
  glDisable(GL_SCISSOR_TEST);
}

}  // namespace engine::render
