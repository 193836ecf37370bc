#pragma once
// The strip below the scene: pause, single step, and a slider through the world's past.

#include "app/session/session.h"
#include "app/ui/widgets/dock.h"

namespace app::ui {

/// Returns the height of the strip in ImGui units.
float time_line_height(float scale);

/// Returns the number of the scene's bodies that have not appeared yet.
std::size_t bodies_to_come(const softbody::BodiesInMotion& world);

void draw_time_line(Widgets& widgets, Session& session, const ScreenRect& area);

}  // namespace app::ui
