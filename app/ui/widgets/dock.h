#pragma once
// Windows of the user interface that are docked at an edge of the program's window, beside the scene.

#include "app/ui/widgets/widgets.h"

namespace app::ui {

/// Begins a docked window over the whole of `area`; ImGui::End() must follow. Unless `opaque`, it draws no background:
/// the frame has been cleared to dock_colour(), which is much faster with software drivers.
void begin_dock(const char* name, const ScreenRect& area, bool opaque, ImGuiWindowFlags flags = 0);

/// The background of all that is not scene.
ImVec4 dock_colour();

}  // namespace app::ui
