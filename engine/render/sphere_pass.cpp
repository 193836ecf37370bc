#include "engine/render/sphere_pass.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <utility>

#include "engine/render/frame_uniforms.h"
#include "engine/render/tessellate.h"

namespace engine::render {
namespace {

/// A tessellated octahedron whose points are moved onto the unit sphere: 1,602 points, and the corners of its
/// triangles. Smaller triangles would cost more on software renderers, because these shade whole blocks of pixels.
std::pair<std::vector<glm::vec3>, std::vector<std::uint32_t>> unit_sphere() {
  constexpr std::array<glm::vec3, 6> corners{glm::vec3(1, 0, 0),  glm::vec3(-1, 0, 0), glm::vec3(0, 1, 0),
                                             glm::vec3(0, -1, 0), glm::vec3(0, 0, 1),  glm::vec3(0, 0, -1)};
  constexpr std::array<std::uint32_t, 24> faces{2, 4, 0, 2, 0, 5, 2, 5, 1, 2, 1, 4, 3, 0, 4, 3, 5, 0, 3, 1, 5, 3, 4, 1};
  TessellatedMesh mesh = tessellate(faces, corners.size(), 20);
  std::vector<glm::vec3> directions;
  for (const auto& [corner, weights] : mesh.vertices) {
    const auto [u, v] = weights;
    directions.push_back(
        glm::normalize(u * corners[corner[0]] + v * corners[corner[1]] + (1.0f - u - v) * corners[corner[2]]));
  }
  return {std::move(directions), std::move(mesh.indices)};
}

}  // namespace

SpherePass::SpherePass(const std::filesystem::path& shaders)
    : program_(scene_program(shaders, "sphere.vert", "surface.frag")),
      shadow_program_(shaders, "sphere_shadow.vert", "depth.frag") {
  const auto [directions, indices] = unit_sphere();
  index_count_ = static_cast<GLsizei>(indices.size());
  array_.bind();
  indices_.set(GL_ELEMENT_ARRAY_BUFFER, std::span(indices));
  directions_.set(GL_ARRAY_BUFFER, std::span(directions));
  set_attributes(directions_, sizeof(glm::vec3), {{3, 0}}, 0, Advance::per_vertex);
  set_attributes(instance_buffer_, sizeof(Instance),
                 {{4, offsetof(Instance, sphere)},
                  {2, offsetof(Instance, occluders), true},
                  {3, offsetof(Instance, colour)},
                  {3, offsetof(Instance, segment)}},
                 1);
}

void SpherePass::update(const FrameData& frame, const AmbientOcclusion& occlusion) {
  instances_.clear();
  for (std::size_t i = 0; i < frame.spheres.size(); ++i) {
    const std::size_t at = frame.meshes.size() + i;
    instances_.push_back({occlusion.spheres()[at], occlusion.ranges()[at], frame.spheres[i].colour});
  }
  for (const Capsule& c : frame.capsules)
    instances_.push_back({glm::vec4(c.from, c.radius), {}, c.colour, c.to - c.from});
  if (!instances_.empty()) instance_buffer_.stream(GL_ARRAY_BUFFER, std::span<const Instance>(instances_));
}

void SpherePass::draw_shadows(const glm::mat4& light_clip_from_world) const {
  shadow_program_.use();
  shadow_program_.set("light_clip_from_world", light_clip_from_world);
  draw_instances();
}

void SpherePass::draw() const {
  program_.use();
  draw_instances();
}

void SpherePass::draw_instances() const {
  if (instances_.empty()) return;
  array_.bind();
  glEnable(GL_CULL_FACE);
  glDrawElementsInstanced(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr,
                          static_cast<GLsizei>(instances_.size()));
  glDisable(GL_CULL_FACE);
}

}  // namespace engine::render
