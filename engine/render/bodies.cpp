#include "engine/render/bodies.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "engine/render/frame_block.h"
#include "engine/render/refine.h"

namespace engine {
namespace {

/// The coarsest level whose outline is less than `slack` pixels from round.
int level_for(float radius_in_pixels, std::uint32_t vertex_count) {
  constexpr float slack = 0.5f;
  // On a sphere of n even vertices an edge spans an angle of about sqrt(14.5 / n); every level halves it.
  const float gap = radius_in_pixels * 14.5f / (8.0f * static_cast<float>(vertex_count));
  if (!(gap > slack)) return 0;
  return std::min(static_cast<int>(std::ceil(0.5f * std::log2(gap / slack))), Bodies::levels - 1);
}

void define_texture(const Texture& texture, const Buffer& buffer, int unit, GLenum format) {
  texture.bind(unit, GL_TEXTURE_BUFFER);
  glTexBuffer(GL_TEXTURE_BUFFER, format, buffer.id());
}

}  // namespace

Bodies::Bodies(const std::filesystem::path& shaders)
    : program_(scene_program(shaders, "body.vert", "surface.frag")),
      shadow_program_(scene_program(shaders, "body_shadow.vert", "depth.frag")) {}

MeshHandle Bodies::add_mesh(std::span<const std::uint32_t> triangles, std::uint32_t vertex_count) {
  if (triangles.size() % 3 != 0 || std::ranges::any_of(triangles, [&](auto index) { return index >= vertex_count; })) {
    throw std::invalid_argument("a mesh of " + std::to_string(vertex_count) +
                                " vertices has an index beyond them, or an unfinished triangle");
  }
  meshes_.push_back({{triangles.begin(), triangles.end()}, vertex_count, is_closed(triangles), {}});
  return {static_cast<std::uint32_t>(meshes_.size() - 1)};
}

const Bodies::Level& Bodies::level_of(Mesh& mesh, int level) const {
  std::unique_ptr<Level>& made = mesh.refined[static_cast<std::size_t>(level)];
  if (made) return *made;
  made = std::make_unique<Level>();
  const RefinedMesh refined = refine(mesh.triangles, mesh.vertex_count, 1 << level);
  made->array.bind();
  made->index_count = static_cast<GLsizei>(refined.indices.size());
  made->indices.set(GL_ELEMENT_ARRAY_BUFFER, std::span(refined.indices));
  made->vertices.set(GL_ARRAY_BUFFER, std::span(refined.vertices));
  constexpr GLsizei stride = sizeof(RefinedVertex);
  glVertexAttribIPointer(0, 3, GL_UNSIGNED_INT, stride, attribute_offset(offsetof(RefinedVertex, corners)));
  glVertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, stride, attribute_offset(offsetof(RefinedVertex, weights)));
  describe_instances();
  return *made;
}

void Bodies::describe_instances() const {
  constexpr GLsizei stride = sizeof(Instance);
  glBindBuffer(GL_ARRAY_BUFFER, instances_.id());
  glVertexAttribIPointer(2, 1, GL_UNSIGNED_INT, stride, attribute_offset(offsetof(Instance, first_vertex)));
  glVertexAttribPointer(3, 1, GL_FLOAT, GL_FALSE, stride, attribute_offset(offsetof(Instance, radius)));
  glVertexAttribIPointer(4, 2, GL_UNSIGNED_INT, stride, attribute_offset(offsetof(Instance, occluders)));
  glVertexAttribPointer(5, 3, GL_FLOAT, GL_FALSE, stride, attribute_offset(offsetof(Instance, colour)));
  for (GLuint attribute = 0; attribute < 6; ++attribute) {
    glEnableVertexAttribArray(attribute);
    if (attribute >= 2) glVertexAttribDivisor(attribute, 1);
  }
}

void Bodies::check(const FrameData& frame) const {
  if (frame.positions.size() != frame.normals.size()) {
    throw std::invalid_argument("a frame has " + std::to_string(frame.positions.size()) + " positions but " +
                                std::to_string(frame.normals.size()) + " normals");
  }
  for (const MeshDraw& draw : frame.meshes) check(draw, frame);
  for (const TranslucentSet& set : frame.translucent)
    for (const MeshDraw& draw : set.meshes) check(draw, frame);
}

void Bodies::check(const MeshDraw& draw, const FrameData& frame) const {
  const bool known = draw.mesh.index < meshes_.size();
  const std::size_t end = std::size_t{draw.first_vertex} + draw.vertex_count;
  if (known && meshes_[draw.mesh.index].vertex_count == draw.vertex_count && end <= frame.positions.size()) return;
  throw std::invalid_argument("a draw of mesh " + std::to_string(draw.mesh.index) + " over vertices " +
                              std::to_string(draw.first_vertex) + " to " + std::to_string(end) + " of " +
                              std::to_string(frame.positions.size()) + " does not fit");
}

void Bodies::update(const FrameData& frame, const Occlusion& occlusion, const glm::vec3& eye,
                    float pixels_at_one_metre) {
  collect(frame, occlusion, eye, pixels_at_one_metre);
  occluder_buffer_.stream(GL_TEXTURE_BUFFER, occlusion.occluders());
  define_texture(occluders_, occluder_buffer_, unit_occluders, GL_RGBA32F);
  collect_translucent(frame, eye, pixels_at_one_metre);
  if (frame.positions.empty()) return;
  position_buffer_.stream(GL_TEXTURE_BUFFER, frame.positions);
  define_texture(positions_, position_buffer_, unit_positions, GL_R32F);
  normal_buffer_.stream(GL_TEXTURE_BUFFER, frame.normals);
  define_texture(normals_, normal_buffer_, unit_normals, GL_R32F);
}

// From front to back: what is hidden is not shaded.
void Bodies::collect(const FrameData& frame, const Occlusion& occlusion, const glm::vec3& eye,
                     float pixels_at_one_metre) {
  distances_.clear();
  for (std::uint32_t i = 0; i < frame.meshes.size(); ++i) {
    distances_.emplace_back(glm::distance(glm::vec3(occlusion.spheres()[i]), eye), i);
  }
  std::ranges::sort(distances_);
  for (auto& [key, batch] : batches_) batch.clear();
  for (const auto& [distance, i] : distances_) {
    const MeshDraw& draw = frame.meshes[i];
    const float radius = std::max(occlusion.spheres()[i].w, 1e-6f);
    const float pixels = pixels_at_one_metre * radius / std::max(distance - radius, 0.1f * radius);
    const int level = frame.rounded ? level_for(pixels, draw.vertex_count) : 0;
    batches_[{draw.mesh.index, level}].push_back({draw.first_vertex, radius, occlusion.ranges()[i], draw.colour});
  }
}

void Bodies::collect_translucent(const FrameData& frame, const glm::vec3& eye, float pixels_at_one_metre) {
  translucent_.clear();
  for (const TranslucentSet& set : frame.translucent) {
    Batches& batches = translucent_.emplace_back(&set, Batches{}).second;
    for (const MeshDraw& draw : set.meshes) {
      const glm::vec4 sphere = mean_sphere(frame.positions.subspan(draw.first_vertex, draw.vertex_count));
      const float radius = std::max(sphere.w, 1e-6f), distance = glm::distance(glm::vec3(sphere), eye);
      const float pixels = pixels_at_one_metre * radius / std::max(distance - radius, 0.1f * radius);
      const int level = frame.rounded ? level_for(pixels, draw.vertex_count) : 0;
      batches[{draw.mesh.index, level}].push_back({draw.first_vertex, radius, {}, draw.colour});
    }
  }
}

void Bodies::draw_shadows(const glm::mat4& light_clip) {
  shadow_program_.use();
  shadow_program_.set("light_clip", light_clip);
  draw_batches(batches_, true);
}

void Bodies::draw() {
  program_.use();
  draw_batches(batches_, false);
}

void Bodies::draw_translucent() {
  if (translucent_.empty()) return;
  program_.use();
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  for (const auto& [set, batches] : translucent_) {
    program_.set("recess", set->recess);
    if (set->hides) {  // depths first, so that only the nearest is seen
      glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
      draw_batches(batches, false);
      glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    }
    glEnable(GL_BLEND);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_FALSE);
    program_.set("opacity", set->opacity);
    draw_batches(batches, false);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glDisable(GL_BLEND);
  }
  program_.set("opacity", 1.0f);
  program_.set("recess", 0.0f);
}

void Bodies::draw_batches(const Batches& batches, bool coarse) {
  for (const auto& [key, batch] : batches) {
    if (batch.empty()) continue;
    Mesh& mesh = meshes_[key.first];
    const Level& level = level_of(mesh, coarse ? 0 : key.second);
    instances_.stream(GL_ARRAY_BUFFER, std::span(batch));
    level.array.bind();
    if (mesh.closed) glEnable(GL_CULL_FACE);
    glDrawElementsInstanced(GL_TRIANGLES, level.index_count, GL_UNSIGNED_INT, nullptr,
                            static_cast<GLsizei>(batch.size()));
    glDisable(GL_CULL_FACE);
  }
}

}  // namespace engine
