#pragma once
// Turns the data of the detector and the bodies into lines, points and boxes. Draws nothing itself.

#include "app/render/scene_view.h"

namespace app::render {

/// Returns the box of a grid cell, with the cells numbered as in §2.2. size: the sides of a cell.
engine::Box cell_box(const compare::Cell& cell, const glm::vec3& size, const glm::vec4& colour);

/// The viewpoint, and the number of pixels that 1 m covers at a distance of 1 m.
struct Viewpoint {
  glm::vec3 eye;
  float pixels_at_one_metre;
};

/// Adds the requested overlays. positions: one for each vertex of the world.
void add_overlays(const softbody::World& world, const OverlayRequest& request, const Viewpoint& viewpoint,
                  std::span<const glm::vec3> positions, engine::FrameData& frame);

}  // namespace app::render
