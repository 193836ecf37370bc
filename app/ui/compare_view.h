#pragma once
// All methods on the same frozen frame, one row each: what it costs, and what it finds of the true contacts.

#include "app/ui/status.h"

namespace app {

/// ImGui units that it needs, in an area of this width.
float compare_height(float width, float scale);
/// Draws the comparison in the area. `show_misses`: set when a method is chosen whose misses the scene is to show.
/// Between begin_frame() and end_frame() of the Gui.
void draw_compare(Widgets& widgets, Session& session, bool& show_misses, const SceneArea& area);

}  // namespace app
