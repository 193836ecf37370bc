#pragma once
// The window of the guided tour, and the labels in the scene.

#include "app/ui/tour/tour.h"
#include "app/ui/views/status.h"
#include "engine/camera.h"

namespace app::ui {

/// Draws the tour's step over the whole of `area`. Call it between begin_frame() and end_frame() of the Gui.
void draw_tour(Widgets& widgets, Session& session, Tour& tour, render::Overlays& shown, const ScreenRect& area);

/// Draws each label beside its point, without overlaps where there is room. `scale`: ImGui units per design pixel;
/// `size`: of the scene's picture, framebuffer pixels.
void draw_labels(std::span<const render::SceneLabel> labels, const engine::Camera& camera, glm::ivec2 size,
                 const ScreenRect& area, float scale);

}  // namespace app::ui
