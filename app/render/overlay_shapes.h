#pragma once
// Turns what the detector and the bodies know into lines, points and boxes. No drawing.

#include "app/render/scene_view.h"

namespace app {

/// A cell of the grid with cells of this size, as §2.2 counts them.
engine::Box cell_box(const Cell& cell, const glm::vec3& size, const glm::vec4& colour);

/// Where the scene is seen from, and how large: what is 1 m large and 1 m away covers so many pixels.
struct Viewpoint {
  glm::vec3 eye;
  float pixels_at_one_metre;
};

/// Adds the overlays asked for. `positions`: one a vertex of the world.
void add_overlays(const softbody::World& world, const OverlayRequest& request, const Viewpoint& viewpoint,
                  std::span<const glm::vec3> positions, engine::FrameData& frame);

}  // namespace app
