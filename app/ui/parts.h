#pragma once
// The parts of the user interface that keep no state of their own: the help, the sidebar, and the time line.

#include "app/ui/state/ui_state.h"
#include "app/ui/widgets/dock.h"

namespace app::ui {

inline constexpr float sidebar_width = 276;  // design pixels

/// Draws the help in the middle of `area`: what the program shows, the keyboard shortcuts and the mouse.
void draw_help(Widgets& widgets, const ScreenRect& area);

/// True if the sidebar has anything to show.
bool has_sidebar(const Session& session, const UiState& ui);
/// Draws the sidebar over `area`, at the right of the scene: the hash table, the selected bucket, the legend of the
/// overlays and the figures of the surface oracle, one below the other. It covers nothing of the scene.
void draw_sidebar(Widgets& widgets, const Session& session, const UiState& ui, const ScreenRect& area);

/// Returns the height of the time line in ImGui units.
float time_line_height(float scale);
/// Returns the number of the scene's bodies that have not appeared yet.
std::size_t bodies_to_come(const softbody::BodiesInMotion& world);
/// Draws the strip below the scene: pause, single step, and a slider through the world's past.
void draw_time_line(Widgets& widgets, const Session& session, const ScreenRect& area);

}  // namespace app::ui
