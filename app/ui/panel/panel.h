#pragma once
// The panel at the left edge. What is needed first stands at the top, the rest is in sections that fold, inside one.
// Changing numbers never move a widget.

#include "app/session/session.h"
#include "app/ui/state/ui_state.h"
#include "app/ui/widgets/dock.h"

namespace app::ui {

inline constexpr float panel_width = 330;  // design pixels

/// Draws the panel over `area`, which is `panel_width` wide. `opaque`: as in begin_dock(). Call it between
/// begin_frame() and end_frame() of the Gui.
void draw_panel(Widgets& widgets, const Session& session, const UiState& ui, const ScreenRect& area, bool opaque);

// The parts of the panel. Each draws into the current window.
/// Where the panel has a value of the scene: with the method, below the line that says whose the settings of hashing
/// are, or in a section.
enum class ValuePlace { method, hashing, detection, world };
/// Draws the values of this place that have a slider in their rows.
void draw_values(Widgets& widgets, const Session& session, ValuePlace place);
void draw_method(Widgets& widgets, const Session& session);
void draw_detection(Widgets& widgets, const Session& session, const UiState& ui);
void draw_bodies(Widgets& widgets, const Session& session, const UiState& ui);
void draw_solids(Widgets& widgets, const Session& session, const UiState& ui);
void draw_world(Widgets& widgets, const Session& session, const UiState& ui);
void draw_numbers(Widgets& widgets, const Session& session, const UiState& ui);
void draw_stability(Widgets& widgets, const Session& session, const UiState& ui);
void draw_files(Widgets& widgets, const Session& session, const UiState& ui);   // import, save, command line
void draw_export(Widgets& widgets, const Session& session, const UiState& ui);  // pictures, recordings, curves

}  // namespace app::ui
