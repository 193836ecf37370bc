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

/// Where the vertices of a world are drawn: of the meshes that it shows, and of those that it simulates.
struct DrawnPoints {
  std::span<const glm::vec3> shown, simulated;
};

/// Adds the requested overlays.
void add_overlays(const softbody::BodiesInMotion& world, const OverlayRequest& request, const Viewpoint& viewpoint,
                  const DrawnPoints& at, engine::FrameData& frame);

}  // namespace app::render
