#pragma once
// The surface oracle's figures of the step last judged.

#include "app/session/session.h"
#include "app/ui/widgets/widgets.h"

namespace app {

/// Draws the figures into the current window, those asked for least often in a section that folds.
void draw_true_surfaces(Widgets& widgets, const Session& session);

}  // namespace app
