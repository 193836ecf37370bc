#include "engine/render/body_pass.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <string>

#include "engine/render/frame_uniforms.h"
#include "engine/render/tessellate.h"

namespace engine::render {
namespace {

constexpr float min_radius = 1e-6f;  // m

/// Returns the coarsest level of detail whose outline differs by less than half a pixel from a round one. `radius` and
/// `distance` (m) are those of the body.
int choose_level(const MeshDraw& draw, float radius, float distance, float pixels_at_one_metre) {
  constexpr float max_gap = 0.5f;  // pixels
  const float radius_in_pixels = pixels_at_one_metre * radius / std::max(distance - radius, 0.1f * radius);
  // On a sphere of n evenly spread vertices, an edge spans an angle of about sqrt(14.5 / n); each level halves it.
  const float gap = radius_in_pixels * 14.5f / (8.0f * static_cast<float>(draw.vertex_count));
  if (!(gap > max_gap)) return 0;
  return std::min(static_cast<int>(std::ceil(0.5f * std::log2(gap / max_gap))), BodyPass::levels - 1);
}

}  // namespace

BodyPass::BodyPass(const std::filesystem::path& shaders)
    : program_(scene_program(shaders, "body.vert", "surface.frag")),
      marked_program_(scene_program(shaders, "body.vert", "surface_marked.frag")),
      shadow_program_(scene_program(shaders, "body_shadow.vert", "depth.frag")) {}

MeshHandle BodyPass::add_mesh(std::span<const std::uint32_t> triangles, std::uint32_t vertex_count) {
  if (triangles.size() % 3 != 0 || std::ranges::any_of(triangles, [&](auto index) { return index >= vertex_count; })) {
    throw std::invalid_argument("a mesh of " + std::to_string(vertex_count) +
                                " vertices has an index beyond them, or an unfinished triangle");
  }
  meshes_.push_back({{triangles.begin(), triangles.end()}, vertex_count, is_closed(triangles), {}});
  return {static_cast<std::uint32_t>(meshes_.size() - 1)};
}

const BodyPass::Level& BodyPass::level_of_detail(Mesh& mesh, int level) const {
  std::unique_ptr<Level>& built = mesh.level[static_cast<std::size_t>(level)];
  if (built) return *built;
  built = std::make_unique<Level>();
  const TessellatedMesh tessellated = tessellate(mesh.triangles, mesh.vertex_count, 1 << level);
  built->array.bind();
  built->index_count = static_cast<GLsizei>(tessellated.indices.size());
  built->indices.set(GL_ELEMENT_ARRAY_BUFFER, std::span(tessellated.indices));
  built->vertices.set(GL_ARRAY_BUFFER, std::span(tessellated.vertices));
  set_attributes(built->vertices, sizeof(TessellatedVertex),
                 {{3, offsetof(TessellatedVertex, corners), true}, {2, offsetof(TessellatedVertex, weights)}}, 0,
                 Advance::per_vertex);
  set_attributes(instances_, sizeof(Instance),
                 {{1, offsetof(Instance, first_vertex), true},
                  {1, offsetof(Instance, radius)},
                  {2, offsetof(Instance, occluders), true},
                  {3, offsetof(Instance, colour)}},
                 2);
  return *built;
}

void BodyPass::check(const FrameData& frame) const {
  if (frame.positions.size() != frame.normals.size()) {
    throw std::invalid_argument("a frame has " + std::to_string(frame.positions.size()) + " positions but " +
                                std::to_string(frame.normals.size()) + " normals");
  }
  if (!frame.marks.empty() && frame.marks.size() != frame.positions.size()) {
    throw std::invalid_argument("a frame has " + std::to_string(frame.positions.size()) + " positions but " +
                                std::to_string(frame.marks.size()) + " marks");
  }
  for (const MeshDraw& draw : frame.meshes) check(draw, frame);
  for (const TranslucentSet& set : frame.translucent)
    for (const MeshDraw& draw : set.meshes) check(draw, frame);
}

void BodyPass::check(const MeshDraw& draw, const FrameData& frame) const {
  const bool known = draw.mesh.index < meshes_.size();
  const std::size_t end = std::size_t{draw.first_vertex} + draw.vertex_count;
  if (known && meshes_[draw.mesh.index].vertex_count == draw.vertex_count && end <= frame.positions.size()) return;
  throw std::invalid_argument("a draw of mesh " + std::to_string(draw.mesh.index) + " over vertices " +
                              std::to_string(draw.first_vertex) + " to " + std::to_string(end) + " of " +
                              std::to_string(frame.positions.size()) + " does not fit");
}

void BodyPass::update(const FrameData& frame, const AmbientOcclusion& occlusion, const glm::vec3& eye,
                      float pixels_at_one_metre) {
  build_batches(frame, occlusion, eye, pixels_at_one_metre);
  occluders_.stream(unit_occluders, occlusion.occluders());
  if (frame.positions.empty()) return;
  positions_.stream(unit_positions, frame.positions);
  normals_.stream(unit_normals, frame.normals);
  marks_.stream(unit_marks, std::span(frame.marks));
}

void BodyPass::build_batches(const FrameData& frame, const AmbientOcclusion& occlusion, const glm::vec3& eye,
                             float pixels_at_one_metre) {
  const auto add = [&](Batches& batches, const MeshDraw& draw, const glm::vec4& sphere,
                       const OccluderRange& occluders) {
    const float radius = std::max(sphere.w, min_radius), distance = glm::distance(glm::vec3(sphere), eye);
    const int level = frame.tessellated ? choose_level(draw, radius, distance, pixels_at_one_metre) : 0;
    batches[{draw.mesh.index, level}].push_back({draw.first_vertex, radius, occluders, draw.colour});
  };
  distances_.clear();
  for (std::uint32_t i = 0; i < frame.meshes.size(); ++i) {
    distances_.emplace_back(glm::distance(glm::vec3(occlusion.spheres()[i]), eye), i);
  }
  std::ranges::sort(distances_);  // from front to back, so that hidden pixels are not shaded
  for (auto& [key, batch] : batches_) batch.clear();
  for (const auto& [distance, i] : distances_)
    add(batches_, frame.meshes[i], occlusion.spheres()[i], occlusion.ranges()[i]);
  translucent_.clear();
  for (const TranslucentSet& set : frame.translucent) {
    Batches& batches = translucent_.emplace_back(&set, Batches{}).second;
    for (const MeshDraw& draw : set.meshes)
      add(batches, draw, mean_sphere(frame.positions.subspan(draw.first_vertex, draw.vertex_count)), {});
  }
}

void BodyPass::draw_shadows(const glm::mat4& light_clip_from_world) {
  shadow_program_.use();
  shadow_program_.set("light_clip_from_world", light_clip_from_world);
  draw_batches(batches_, true);
}

void BodyPass::draw(const FrameData& frame) {
  const Program& program = frame.marks.empty() ? program_ : marked_program_;
  program.use();
  if (!frame.marks.empty()) program.set("mark_colour", frame.mark_colour);
  draw_batches(batches_, false);
}

void BodyPass::draw_translucent(bool hiding) {
  if (translucent_.empty()) return;
  program_.use();
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glEnable(GL_STENCIL_TEST);
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  for (const auto& [set, batches] : translucent_) {
    if (set->hides != hiding) continue;
    glStencilFunc(set->behind_bodies ? GL_EQUAL : GL_ALWAYS, set->behind_bodies ? 0 : GLint{stencil_bodies},
                  stencil_bodies);
    // The depth comes first, so that only the nearest surface gets a colour.
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    draw_batches(batches, false);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glEnable(GL_BLEND);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_FALSE);
    program_.set("opacity", set->opacity);
    draw_batches(batches, false);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glDisable(GL_BLEND);
  }
  glDisable(GL_STENCIL_TEST);
  program_.set("opacity", 1.0f);
}

void BodyPass::draw_batches(const Batches& batches, bool coarsest) {
  for (const auto& [key, batch] : batches) {
    if (batch.empty()) continue;
    Mesh& mesh = meshes_[key.first];
    const Level& level = level_of_detail(mesh, coarsest ? 0 : key.second);
    instances_.stream(GL_ARRAY_BUFFER, std::span(batch));
    level.array.bind();
    if (mesh.closed) glEnable(GL_CULL_FACE);
    glDrawElementsInstanced(GL_TRIANGLES, level.index_count, GL_UNSIGNED_INT, nullptr,
                            static_cast<GLsizei>(batch.size()));
    glDisable(GL_CULL_FACE);
  }
}

}  // namespace engine::render
