#pragma once
// The surface oracle's figures of the step last judged.

#include "app/demo/status.h"

namespace app {

/// Draws the figures in the upper left corner of the area, while overlays.true_surfaces is on, and returns what is left
/// of it at their right. Between begin_frame() and end_frame() of the Gui.
SceneArea draw_true_surfaces(Widgets& widgets, const Session& session, const SceneArea& area);

}  // namespace app
