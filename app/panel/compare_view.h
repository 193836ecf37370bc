#pragma once
// All methods on the same frozen frame, one row each: what it costs, and what it finds of the true contacts.

#include "app/demo/status.h"

namespace app {

/// ImGui units that it needs, in an area of this width.
float compare_height(float width, float scale);
/// Draws the comparison in the area. Between begin_frame() and end_frame() of the Gui.
void draw_compare(Widgets& widgets, Session& session, const SceneArea& area);

}  // namespace app
