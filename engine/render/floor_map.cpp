#include "engine/render/floor_map.h"

#include <cassert>
#include <cstddef>

#include "engine/render/floor_regions.h"
#include "engine/render/frame_uniforms.h"

namespace engine::render {

FloorMap::FloorMap(const std::filesystem::path& shaders)
    : program_(shaders, "floor_map.vert", "floor_map.frag"), framebuffer_(generated(glGenFramebuffers)) {
  map_.bind(unit_floor_map, GL_TEXTURE_2D);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size, size, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  set_linear_clamped();
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, map_.id(), 0);
  array_.bind();
  set_attributes(instance_buffer_, sizeof(Instance),
                 {{4, offsetof(Instance, sphere)}, {3, offsetof(Instance, colour)}});
}

void FloorMap::draw(const FrameData& frame, const AmbientOcclusion& occlusion) {
  assert(frame.floor_height);
  instances_.clear();
  for (std::size_t i = 0; i < occlusion.spheres().size(); ++i) {
    const glm::vec4& sphere = occlusion.spheres()[i];
    const std::size_t bodies = frame.meshes.size();
    // A sphere above occlusion_height darkens the floor by less than 1 %.
    if (sphere.y - *frame.floor_height > occlusion_height * sphere.w || sphere.y + sphere.w < *frame.floor_height)
      continue;
    instances_.push_back({sphere, i < bodies ? frame.meshes[i].colour : frame.spheres[i - bodies].colour});
  }
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
  glViewport(0, 0, size, size);
  glClearColor(1.0f, 1.0f, 1.0f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  if (instances_.empty()) return;
  instance_buffer_.stream(GL_ARRAY_BUFFER, std::span<const Instance>(instances_));
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendFunc(GL_DST_COLOR, GL_ZERO);
  program_.use();
  array_.bind();
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(instances_.size()));
  glDisable(GL_BLEND);
  glEnable(GL_DEPTH_TEST);
}

}  // namespace engine::render
