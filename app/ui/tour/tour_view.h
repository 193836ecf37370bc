#pragma once
// The window of the guided tour.

#include "app/ui/tour/tour.h"
#include "app/ui/views/status.h"

namespace app::ui {

/// Draws the tour's step over the whole of `area`. Call it between begin_frame() and end_frame() of the Gui.
void draw_tour(Widgets& widgets, Session& session, Tour& tour, render::Overlays& shown, const ScreenRect& area);

}  // namespace app::ui
