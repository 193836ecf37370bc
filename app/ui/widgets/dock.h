#pragma once
// Windows of the interface that stand at an edge of the program's window, beside the scene and never over it.

#include "app/ui/widgets/widgets.h"

namespace app {

/// A part of the display, in ImGui units.
struct SceneArea {
  ImVec2 min, max;
};

/// A docked window over the whole area; end_dock() must follow. Without `opaque` it draws no ground of its own: the
/// frame has been cleared to dock_colour(), which costs drivers in software far less.
void begin_dock(const char* name, const SceneArea& area, bool opaque, ImGuiWindowFlags flags = 0);
void end_dock();

/// What stands where no scene is.
ImVec4 dock_colour();

}  // namespace app
