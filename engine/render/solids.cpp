#include "engine/render/solids.h"

#include <array>
#include <cstddef>
#include <glm/geometric.hpp>

#include "engine/render/floor_cells.h"
#include "engine/render/frame_block.h"
#include "engine/render/refine.h"

namespace engine {
namespace {

struct UnitSphere {
  std::vector<glm::vec3> directions;
  std::vector<std::uint32_t> indices;
};

/// An octahedron cut fine and blown up: 1,602 points. Drivers in software shade blocks of pixels, so smaller triangles
/// would cost more.
UnitSphere unit_sphere() {
  constexpr std::array<glm::vec3, 6> corners{glm::vec3(1, 0, 0),  glm::vec3(-1, 0, 0), glm::vec3(0, 1, 0),
                                             glm::vec3(0, -1, 0), glm::vec3(0, 0, 1),  glm::vec3(0, 0, -1)};
  constexpr std::array<std::uint32_t, 24> faces{2, 4, 0, 2, 0, 5, 2, 5, 1, 2, 1, 4, 3, 0, 4, 3, 5, 0, 3, 1, 5, 3, 4, 1};
  RefinedMesh mesh = refine(faces, corners.size(), 20);
  UnitSphere sphere;
  for (const RefinedVertex& vertex : mesh.vertices) {
    const auto [u, v] = vertex.weights;
    sphere.directions.push_back(glm::normalize(u * corners[vertex.corners[0]] + v * corners[vertex.corners[1]] +
                                               (1.0f - u - v) * corners[vertex.corners[2]]));
  }
  sphere.indices = std::move(mesh.indices);
  return sphere;
}

}  // namespace

Spheres::Spheres(const std::filesystem::path& shaders)
    : program_(scene_program(shaders, "sphere.vert", "surface.frag")),
      shadow_program_(shaders, "sphere_shadow.vert", "depth.frag") {
  const UnitSphere sphere = unit_sphere();
  index_count_ = static_cast<GLsizei>(sphere.indices.size());
  array_.bind();
  indices_.set(GL_ELEMENT_ARRAY_BUFFER, std::span(sphere.indices));
  directions_.set(GL_ARRAY_BUFFER, std::span(sphere.directions));
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(glm::vec3), nullptr);
  constexpr GLsizei stride = sizeof(Instance);
  glBindBuffer(GL_ARRAY_BUFFER, instance_buffer_.id());
  glVertexAttribPointer(1, 4, GL_FLOAT, GL_FALSE, stride, attribute_offset(offsetof(Instance, sphere)));
  glVertexAttribIPointer(2, 2, GL_UNSIGNED_INT, stride, attribute_offset(offsetof(Instance, occluders)));
  glVertexAttribPointer(3, 3, GL_FLOAT, GL_FALSE, stride, attribute_offset(offsetof(Instance, colour)));
  glVertexAttribPointer(4, 3, GL_FLOAT, GL_FALSE, stride, attribute_offset(offsetof(Instance, segment)));
  for (GLuint attribute = 0; attribute < 5; ++attribute) {
    glEnableVertexAttribArray(attribute);
    if (attribute >= 1) glVertexAttribDivisor(attribute, 1);
  }
}

void Spheres::update(const FrameData& frame, const Occlusion& occlusion) {
  instances_.clear();
  for (std::size_t i = 0; i < frame.spheres.size(); ++i) {
    const std::size_t at = frame.meshes.size() + i;
    instances_.push_back({occlusion.spheres()[at], occlusion.ranges()[at], frame.spheres[i].colour});
  }
  for (const Capsule& c : frame.capsules)
    instances_.push_back({glm::vec4(c.from, c.radius), {}, c.colour, c.to - c.from});
  if (!instances_.empty()) instance_buffer_.stream(GL_ARRAY_BUFFER, std::span<const Instance>(instances_));
}

void Spheres::draw_shadows(const glm::mat4& light_clip) const {
  if (instances_.empty()) return;
  shadow_program_.use();
  shadow_program_.set("light_clip", light_clip);
  draw_instances();
}

void Spheres::draw() const {
  if (instances_.empty()) return;
  program_.use();
  draw_instances();
}

void Spheres::draw_instances() const {
  array_.bind();
  glEnable(GL_CULL_FACE);
  glDrawElementsInstanced(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr,
                          static_cast<GLsizei>(instances_.size()));
  glDisable(GL_CULL_FACE);
}

FloorMap::FloorMap(const std::filesystem::path& shaders) : program_(shaders, "floor_map.vert", "floor_map.frag") {
  map_.bind(unit_floor_map, GL_TEXTURE_2D);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size, size, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  framebuffer_ = GlName<detail::delete_framebuffer>(name);
  glBindFramebuffer(GL_FRAMEBUFFER, name);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, map_.id(), 0);
  array_.bind();
  glBindBuffer(GL_ARRAY_BUFFER, instance_buffer_.id());
  glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, sizeof(Instance), attribute_offset(offsetof(Instance, sphere)));
  glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, sizeof(Instance), attribute_offset(offsetof(Instance, colour)));
  for (GLuint attribute = 0; attribute < 2; ++attribute) {
    glEnableVertexAttribArray(attribute);
    glVertexAttribDivisor(attribute, 1);
  }
}

void FloorMap::draw(const FrameData& frame, const Occlusion& occlusion) {
  instances_.clear();
  for (std::size_t i = 0; i < occlusion.spheres().size(); ++i) {
    const glm::vec4& sphere = occlusion.spheres()[i];
    const std::size_t bodies = frame.meshes.size();
    // Higher up than this it darkens the floor by less than one part in a hundred.
    if (sphere.y - *frame.ground > sky_height * sphere.w || sphere.y + sphere.w < *frame.ground) continue;
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

}  // namespace engine
