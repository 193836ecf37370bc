#pragma once
// The help overlay: what the program shows, the keyboard and the mouse.

#include "app/ui/status.h"
#include "app/ui/widgets/widgets.h"

namespace app {

/// Draws the help in the middle of the area; `open` becomes false when it is closed.
void draw_help(Widgets& widgets, const SceneArea& area, bool& open);

}  // namespace app
