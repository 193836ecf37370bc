#pragma once
// The surface oracle's figures of the step last judged.

#include "app/demo/status.h"

namespace app {

/// Draws the figures at the left of the area below `top`, while overlays.true_surfaces is on, and returns where they
/// end: what else stands there has to stay below. Between begin_frame() and end_frame() of the Gui.
float draw_true_surfaces(Widgets& widgets, const Session& session, const SceneArea& area, float top);

}  // namespace app
