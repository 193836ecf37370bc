#pragma once
// The comparison of methods on one frozen frame: a row for each shown method with its cost and its true contacts.

#include "app/ui/views/status.h"

namespace app::ui {

/// Returns the height in ImGui units that the comparison of so many methods needs in an area of this width.
float compare_height(std::size_t methods, float width, float scale);
/// Draws the comparison over `area`. Sets `show_misses` when the user chooses the method whose misses the scene shows,
/// and `open` to false when the user closes the comparison. Call it between begin_frame() and end_frame() of the Gui.
void draw_compare(Widgets& widgets, Session& session, bool& show_misses, bool& open, const ScreenRect& area);

}  // namespace app::ui
