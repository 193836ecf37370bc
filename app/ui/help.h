#pragma once
// The help window: what the program shows, the keyboard shortcuts and the mouse.

#include "app/ui/views/status.h"
#include "app/ui/widgets/widgets.h"

namespace app::ui {

/// Draws the help in the middle of `area`. Its close button sets `open` to false.
void draw_help(Widgets& widgets, const ScreenRect& area, bool& open);

}  // namespace app::ui
