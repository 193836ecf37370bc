#pragma once
// Texts and rings over the scene.

#include <optional>
#include <span>
#include <vector>

#include "app/render/highlight.h"
#include "app/ui/widgets/dock.h"
#include "engine/camera.h"

namespace app::ui {

/// A text of `size` that belongs to a point on the screen, with a ring of radius `ring` round the point (0: none). All
/// in ImGui units.
struct LabelOnScreen {
  ImVec2 point, size;
  float ring = 0;
};

/// Returns a place within `area` beside its point for each text; nothing where none is free. No text covers another
/// text or a ring. `scale`: ImGui units per design pixel.
std::vector<std::optional<ScreenRect>> place_texts(std::span<const LabelOnScreen> labels, const ScreenRect& area,
                                                   float scale);

/// Draws the rings of the labels, and their texts where there is room, earlier ones first. `size`: of the scene's
/// picture, framebuffer pixels. Call it between begin_frame() and end_frame() of the Gui.
void draw_labels(std::span<const render::SceneLabel> labels, const engine::Camera& camera, glm::ivec2 size,
                 const ScreenRect& area, float scale);

}  // namespace app::ui
