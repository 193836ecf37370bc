#pragma once
// The marks of the methods: each has a colour and a shape of its own, the same in all views.

#include "app/compare/method_style.h"
#include "app/ui/widgets/widgets.h"

namespace app::ui {

/// Draws a marker. `line`: the width of its strokes.
void draw_marker(ImVec2 at, float radius, compare::Marker marker, ImU32 colour, float line);

/// Draws the mark of a method in the middle of a line, as an item.
void draw_method_mark(const Widgets& w, const collide::Method& method, float line_height);

}  // namespace app::ui
