#pragma once
// What was found in a file and done to it, beside the panel, so that it moves nothing there.

#include "app/session/import.h"
#include "app/ui/status.h"

namespace app {

/// Draws what is being read and the report on what was, if any, in the lower left corner of the area, until the latter
/// is closed.
void draw_import_report(Widgets& widgets, Import& import, const SceneArea& area);

}  // namespace app
