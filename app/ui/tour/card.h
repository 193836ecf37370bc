#pragma once
// The card of the guided tour, and its labels in the scene.

#include "app/ui/status.h"
#include "app/ui/tour/tour.h"
#include "engine/camera.h"

namespace app {

/// Draws the step as a card that fills the area. Between begin_frame() and end_frame() of the Gui.
void draw_tour(Widgets& widgets, Session& session, Tour& tour, Overlays& shown, const SceneArea& area);

/// Texts beside their points, clear of one another where there is room. scale: ImGui units per design pixel; size: of
/// the scene's picture, framebuffer pixels.
void draw_labels(std::span<const SceneLabel> labels, const engine::Camera& camera, glm::ivec2 size,
                 const SceneArea& area, float scale);

}  // namespace app
