#pragma once
// The panel at the left edge. What is needed first stands at the top, the rest is in sections that fold. Changing
// numbers never move a widget.

#include "app/session/session.h"
#include "app/ui/panel/ui_state.h"
#include "app/ui/widgets/dock.h"

namespace app::ui {

inline constexpr float panel_width = 330;  // design pixels

// Ends of the sliders; typed values are clamped to them too.
inline constexpr float min_tolerance = 0.005f, max_tolerance = 0.5f;  // m
inline constexpr float min_cell = 0.02f, max_cell = 5.0f;             // m

/// Returns the number of the scene's bodies that have not appeared yet.
std::size_t bodies_to_come(const softbody::World& world);

/// Draws the panel over `area`, which is `panel_width` wide. `opaque`: as in begin_dock(). Call it between
/// begin_frame() and end_frame() of the Gui.
void draw_panel(Widgets& widgets, Session& session, UiState& ui, const ScreenRect& area, bool opaque);

// The parts of the panel. Each draws into the current window.
/// `structure_shown`: boxes, cells or the hash table of the paper's method are shown, so its settings are enabled.
void draw_detection(Widgets& widgets, Session& session, bool structure_shown);
void draw_bodies(Widgets& widgets, Session& session, UiState& ui);
void draw_world(Widgets& widgets, Session& session, UiState& ui);
void draw_numbers(Widgets& widgets, const Session& session, float render_scale);
void draw_stability(Widgets& widgets, Session& session);
void draw_files(Widgets& widgets, Session& session, UiState& ui);      // import, save, command line
void draw_take_away(Widgets& widgets, Session& session, UiState& ui);  // pictures, recordings, curves

}  // namespace app::ui
