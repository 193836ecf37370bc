#pragma once
// The panel at the left: what one needs first stands first, the rest folds. Numbers never move it.

#include "app/session/session.h"
#include "app/ui/ui_state.h"
#include "app/ui/widgets/dock.h"

namespace app {

inline constexpr float panel_width = 330;  // design pixels

// Ends of the sliders; typed values stay within them too.
inline constexpr float tolerance_from = 0.005f, tolerance_to = 0.5f;  // m
inline constexpr float least_cell = 0.02f, most_cell = 5.0f;          // m

/// Draws the panel over the area, `panel_width` wide; `opaque`: as begin_dock(). Between begin_frame() and end_frame()
/// of the Gui.
void draw_panel(Widgets& widgets, Session& session, UiState& ui, const SceneArea& area, bool opaque);

// Its sections, each for a window already begun.
/// structure_shown: boxes, cells or the hash table of the paper's method are shown, so its settings are offered.
void draw_detection(Widgets& widgets, Session& session, bool structure_shown);
void draw_touch(Widgets& widgets, Session& session, UiState& ui);
void draw_world(Widgets& widgets, Session& session, UiState& ui);
void draw_numbers(Widgets& widgets, const Session& session, float render_scale);
void draw_stability(Widgets& widgets, Session& session);
void draw_files(Widgets& widgets, Session& session, UiState& ui);      // bring your own, save, reproduce
void draw_take_away(Widgets& widgets, Session& session, UiState& ui);  // pictures, recordings, curves

}  // namespace app
