#include "engine/render/studio.h"

#include "engine/render/frame_block.h"

namespace engine {
namespace {

/// Two triangles, counter-clockwise from above.
void append(std::vector<glm::vec2>& corners, const FloorArea& area) {
  const glm::vec2 a = area.lo, b(area.lo.x, area.hi.y), c(area.hi.x, area.lo.y), d = area.hi;
  corners.insert(corners.end(), {a, b, c, c, b, d});
}

/// The cells with shadows, those side by side in a row as one area: few large triangles cost drivers in software less
/// than many small ones. Rows overlap a little, so that no pixel falls between them.
void append_runs(std::vector<glm::vec2>& corners, const FloorCells& cells) {
  const FloorArea& all = cells.shadowed();
  const glm::vec2 side = (all.hi - all.lo) / static_cast<float>(FloorCells::side);
  const auto corner = [&](int column, float row) { return all.lo + side * glm::vec2(column, row); };
  constexpr float overlap = 0.02f;  // of a cell
  for (int row = 0; row < FloorCells::side; ++row) {
    for (int column = 0; column < FloorCells::side; ++column) {
      if (!cells.shadowed(column, row)) continue;
      const int first = column;
      while (column < FloorCells::side && cells.shadowed(column, row)) ++column;
      const auto top = static_cast<float>(row);
      append(corners, {corner(first, top - overlap), corner(column, top + 1.0f + overlap)});
    }
  }
}

}  // namespace

Studio::Studio(const std::filesystem::path& shaders)
    : open_(scene_program(shaders, "floor.vert", "floor_open.frag")),
      shaded_(scene_program(shaders, "floor.vert", "floor_shaded.frag")),
      shadowed_(scene_program(shaders, "floor.vert", "floor_shadowed.frag")),
      backdrop_(shaders, "backdrop.vert", "backdrop.frag") {
  array_.bind();
  glBindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, sizeof(glm::vec2), nullptr);
  glEnableVertexAttribArray(0);
}

void Studio::update(const FrameData& frame, std::span<const glm::vec4> spheres, const glm::vec3& to_light, float soft) {
  if (!frame.ground) return;
  const glm::vec2 centre(frame.bounds_centre.x, frame.bounds_centre.z);
  // Twice the radius: light comes from the side, but what is further out has no shadow in the map.
  cells_.update(spheres, {centre, 2.0f * frame.bounds_radius, *frame.ground}, to_light, soft);
  corners_.clear();
  const float half = 7.0f * frame.bounds_radius;  // further out it has faded into the backdrop
  append(corners_, {centre - half, centre + half});
  append(corners_, cells_.shaded().empty() ? FloorArea{centre, centre} : cells_.shaded());
  if (!cells_.shadowed().empty()) append_runs(corners_, cells_);
  buffer_.stream(GL_ARRAY_BUFFER, std::span<const glm::vec2>(corners_));
}

void Studio::draw(bool with_floor) const {
  if (with_floor) draw_floor();
  // Last and farthest away, so that it is computed only where nothing else is.
  empty_.bind();
  glDepthFunc(GL_LEQUAL);
  backdrop_.use();
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

// In layers, from the costliest on top to the plainest below: no seam can show what is not floor.
void Studio::draw_floor() const {
  constexpr GLint square = 6;  // corners
  const auto draw = [&](const Program& program, GLint first, GLsizei count, float behind) {
    program.use();
    glPolygonOffset(behind, 4.0f * behind);
    glDrawArrays(GL_TRIANGLES, first, count);
  };
  array_.bind();
  // From below there is no floor: one looks through it at the bodies that lie on it.
  glEnable(GL_CULL_FACE);
  glEnable(GL_POLYGON_OFFSET_FILL);
  draw(shadowed_, 2 * square, static_cast<GLsizei>(corners_.size()) - 2 * square, 0.0f);
  draw(shaded_, square, square, 1.0f);
  draw(open_, 0, square, 2.0f);
  glDisable(GL_POLYGON_OFFSET_FILL);
  glDisable(GL_CULL_FACE);
}

}  // namespace engine
