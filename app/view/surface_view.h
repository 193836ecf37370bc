#pragma once
// The surface oracle's figures of the step last judged.

#include "app/demo/session.h"
#include "app/panel/widgets.h"

namespace app {

/// Draws the figures into the current window, those asked for least often in a section that folds.
void draw_true_surfaces(Widgets& widgets, const Session& session);

}  // namespace app
