#include "engine/render/studio.h"

#include "engine/render/frame_block.h"

namespace engine {
namespace {

void append_cell(std::vector<std::uint16_t>& corners, int column, int row) {
  constexpr int next_row = FloorCells::side + 1;
  const int first = row * next_row + column;
  for (const int corner : {0, next_row, 1, 1, next_row, next_row + 1}) {
    corners.push_back(static_cast<std::uint16_t>(first + corner));
  }
}

}  // namespace

Studio::Studio(const std::filesystem::path& shaders)
    : open_(scene_program(shaders, "floor.vert", "floor_open.frag")),
      shaded_(scene_program(shaders, "floor.vert", "floor_shaded.frag")),
      shadowed_(scene_program(shaders, "floor.vert", "floor_shadowed.frag")),
      backdrop_(shaders, "backdrop.vert", "backdrop.frag") {}

void Studio::update(const FrameData& frame, std::span<const glm::vec4> spheres, const glm::vec3& to_light, float soft) {
  if (!frame.ground) return;
  floor_ = {{frame.bounds_centre.x, frame.bounds_centre.z}, frame.bounds_radius, *frame.ground};
  // Twice the radius: light comes from the side, but what is further out has no shadow in the map.
  cells_.update(spheres, {floor_.centre, 2.0f * floor_.reach, floor_.height}, to_light, soft);
  corners_.clear();
  for (int row = 0; row < FloorCells::side; ++row) {
    for (int column = 0; column < FloorCells::side; ++column) {
      if (cells_.shadowed(column, row)) append_cell(corners_, column, row);
    }
  }
  array_.bind();
  indices_.stream(GL_ELEMENT_ARRAY_BUFFER, std::span<const std::uint16_t>(corners_));
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
  // From below there is no floor: one looks through it at the bodies that lie on it.
  glEnable(GL_CULL_FACE);
  draw_shadowed_cells();
  glEnable(GL_POLYGON_OFFSET_FILL);
  if (!cells_.shaded().empty()) draw_square(shaded_, cells_.shaded(), 1.0f);
  const float half = 7.0f * floor_.reach;  // further out it has faded into the backdrop
  draw_square(open_, {floor_.centre - half, floor_.centre + half}, 2.0f);
  glDisable(GL_POLYGON_OFFSET_FILL);
  glDisable(GL_CULL_FACE);
}

void Studio::draw_shadowed_cells() const {
  if (corners_.empty()) return;
  const FloorArea& all = cells_.shadowed();
  shadowed_.use();
  shadowed_.set("cells", glm::vec4(all.lo, (all.hi - all.lo) / static_cast<float>(FloorCells::side)));
  shadowed_.set("corners", FloorCells::side + 1);
  array_.bind();
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(corners_.size()), GL_UNSIGNED_SHORT, nullptr);
}

void Studio::draw_square(const Program& program, const FloorArea& area, float behind) const {
  program.use();
  program.set("cells", glm::vec4(area.lo, area.hi - area.lo));
  program.set("corners", 2);
  glPolygonOffset(behind, 4.0f * behind);
  empty_.bind();
  glCullFace(GL_FRONT);  // a strip's corners, counted row by row, go round the other way
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  glCullFace(GL_BACK);
}

}  // namespace engine
