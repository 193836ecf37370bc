#pragma once
// The surface oracle's figures of the last step that it judged.

#include "app/session/session.h"
#include "app/ui/widgets/widgets.h"

namespace app::ui {

/// Draws the figures into the current window. The rarely needed ones are in a section that is folded at first.
void draw_true_surfaces(Widgets& widgets, const Session& session);

}  // namespace app::ui
