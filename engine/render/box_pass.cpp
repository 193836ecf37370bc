#include "engine/render/box_pass.h"

#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/render/frame_uniforms.h"

namespace engine::render {
namespace {

// Of cube.glsl: all vertices, and those of the face y = 1.
constexpr GLint cube_begin = 0, face_begin = 18;
constexpr GLsizei cube_vertices = 36, face_vertices = 6;
constexpr float patch_half_size = 1.5f;  // of a plane's patch, in radii of the scene

/// A right-handed orthonormal basis x, n, z round the unit vector `n`.
glm::mat3 basis_round(const glm::vec3& n) {
  const glm::vec3 other = std::abs(n.x) < 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1);
  const glm::vec3 z = glm::normalize(glm::cross(other, n));
  return {glm::cross(n, z), n, z};
}

}  // namespace

BoxPass::BoxPass(const std::filesystem::path& shaders)
    : box_program_(scene_program(shaders, "oriented_box.vert", "surface.frag")),
      shadow_program_(shaders, "oriented_box_shadow.vert", "depth.frag"),
      plane_program_(scene_program(shaders, "plane.vert", "plane.frag")) {}

void BoxPass::update(const FrameData& frame) {
  instances_.clear();
  for (const OrientedBox& b : frame.oriented_boxes) instances_.push_back({b.centre, b.half_axes, b.colour});
  box_count_ = instances_.size();
  for (const Plane& p : frame.planes) {
    assert(std::abs(glm::length(p.normal) - 1.0f) < 1e-3f);
    const glm::vec3 foot = frame.bounds_centre - glm::dot(frame.bounds_centre - p.point, p.normal) * p.normal;
    glm::mat3 axes = basis_round(p.normal);
    for (const int across : {0, 2}) axes[across] *= patch_half_size * frame.bounds_radius;
    instances_.push_back({foot - p.normal, axes, {}});  // the cube's face is 1 m above its centre
  }
  if (!instances_.empty()) instance_buffer_.stream(GL_ARRAY_BUFFER, std::span<const Instance>(instances_));
}

void BoxPass::draw_shadows(const glm::mat4& light_clip_from_world) const {
  shadow_program_.use();
  shadow_program_.set("light_clip_from_world", light_clip_from_world);
  draw_instances(0, box_count_, cube_begin, cube_vertices);
}

void BoxPass::draw() const {
  box_program_.use();
  draw_instances(0, box_count_, cube_begin, cube_vertices);
  plane_program_.use();
  draw_instances(box_count_, instances_.size() - box_count_, face_begin, face_vertices);
}

void BoxPass::draw_instances(std::size_t first, std::size_t count, GLint begin, GLsizei vertices) const {
  if (count == 0) return;
  array_.bind();
  const std::size_t start = first * sizeof(Instance), axes = start + offsetof(Instance, half_axes);
  set_attributes(instance_buffer_, sizeof(Instance),
                 {{3, start + offsetof(Instance, centre)},
                  {3, axes},
                  {3, axes + sizeof(glm::vec3)},
                  {3, axes + 2 * sizeof(glm::vec3)},
                  {3, start + offsetof(Instance, colour)}});
  glEnable(GL_CULL_FACE);
  glDrawArraysInstanced(GL_TRIANGLES, begin, vertices, static_cast<GLsizei>(count));
  glDisable(GL_CULL_FACE);
}

}  // namespace engine::render
