#pragma once
// The report on an imported file: what was found in it and what was done to it. It stands over the scene, so that it
// moves nothing on the panel.

#include "app/session/import.h"
#include "app/ui/views/status.h"

namespace app::ui {

/// Draws the progress of a file that is being read, and the report on the last files until the user closes it, in the
/// lower left corner of `area`. Draws nothing if there is neither.
void draw_import_report(Widgets& widgets, Session& session, session::Import& import, const ScreenRect& area);

}  // namespace app::ui
