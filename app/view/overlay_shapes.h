#pragma once
// Turns what the detector and the bodies know into lines, points and boxes. No drawing.

#include "app/view/scene_view.h"

namespace app {

/// Adds the overlays asked for. `positions`: one a vertex of the world.
void add_overlays(const softbody::World& world, const OverlayRequest& request, std::span<const glm::vec3> positions,
                  engine::FrameData& frame);

}  // namespace app
