#include "engine/render/environment_pass.h"

#include "engine/render/frame_uniforms.h"

namespace engine::render {
namespace {

/// Appends two triangles, counter-clockwise from above.
void append_rect(std::vector<glm::vec2>& vertices, const FloorRect& rect) {
  const glm::vec2 a = rect.lo, b(rect.lo.x, rect.hi.y), c(rect.hi.x, rect.lo.y), d = rect.hi;
  vertices.insert(vertices.end(), {a, b, c, c, b, d});
}

/// Appends the shadowed cells; neighbours in a row become one rectangle, because few large triangles cost software
/// renderers less than many small ones. Rows overlap slightly, so that no pixel falls between them.
void append_shadowed_cells(std::vector<glm::vec2>& vertices, const FloorRegions& regions) {
  constexpr int side = FloorRegions::cells_per_side;
  const FloorRect& all = regions.shadowed();
  const glm::vec2 cell_size = (all.hi - all.lo) / static_cast<float>(side);
  const auto corner = [&](int column, float row) { return all.lo + cell_size * glm::vec2(column, row); };
  constexpr float overlap = 0.02f;  // of a cell
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      if (!regions.is_shadowed(column, row)) continue;
      const int first = column;
      while (column < side && regions.is_shadowed(column, row)) ++column;
      const auto top = static_cast<float>(row);
      append_rect(vertices, {corner(first, top - overlap), corner(column, top + 1.0f + overlap)});
    }
  }
}

}  // namespace

EnvironmentPass::EnvironmentPass(const std::filesystem::path& shaders)
    : lit_(scene_program(shaders, "floor.vert", "floor_lit.frag")),
      occluded_(scene_program(shaders, "floor.vert", "floor_occluded.frag")),
      shadowed_(scene_program(shaders, "floor.vert", "floor_shadowed.frag")),
      backdrop_(shaders, "backdrop.vert", "backdrop.frag") {
  array_.bind();
  set_attributes(buffer_, sizeof(glm::vec2), {{2, 0}}, 0, Advance::per_vertex);
}

void EnvironmentPass::update(const FrameData& frame, std::span<const glm::vec4> casters, const glm::vec3& to_light,
                             float softness) {
  if (!frame.floor_height) return;
  const glm::vec2 centre(frame.bounds_centre.x, frame.bounds_centre.z);
  // Twice the radius, because slanting light casts shadows beside the scene. Farther out the shadow map holds none.
  regions_.update(casters, {centre, 2.0f * frame.bounds_radius, *frame.floor_height}, to_light, softness);
  vertices_.clear();
  const float half_size = 7.0f * frame.bounds_radius;  // there the floor has faded into the backdrop
  append_rect(vertices_, {centre - half_size, centre + half_size});
  append_rect(vertices_, regions_.occluded().empty() ? FloorRect{centre, centre} : regions_.occluded());
  if (!regions_.shadowed().empty()) append_shadowed_cells(vertices_, regions_);
  buffer_.stream(GL_ARRAY_BUFFER, std::span<const glm::vec2>(vertices_));
}

void EnvironmentPass::draw(bool with_floor) const {
  if (with_floor) draw_floor();
  // The backdrop comes last and at the far plane, so that it is shaded only where nothing else is.
  empty_.bind();
  glDepthFunc(GL_LEQUAL);
  backdrop_.use();
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

// Draws three layers: the costliest shader on top, the cheapest at the bottom. A seam in a layer shows the floor below.
void EnvironmentPass::draw_floor() const {
  constexpr GLint rect_vertices = 6;
  const auto draw_layer = [&](const Program& program, GLint first, GLsizei count, float depth_offset) {
    program.use();
    glPolygonOffset(depth_offset, 4.0f * depth_offset);
    glDrawArrays(GL_TRIANGLES, first, count);
  };
  array_.bind();
  // The floor is invisible from below, so that the bodies on it can be seen from there.
  glEnable(GL_CULL_FACE);
  glEnable(GL_POLYGON_OFFSET_FILL);
  draw_layer(shadowed_, 2 * rect_vertices, static_cast<GLsizei>(vertices_.size()) - 2 * rect_vertices, 0.0f);
  draw_layer(occluded_, rect_vertices, rect_vertices, 1.0f);
  draw_layer(lit_, 0, rect_vertices, 2.0f);
  glDisable(GL_POLYGON_OFFSET_FILL);
  glDisable(GL_CULL_FACE);
}

}  // namespace engine::render
