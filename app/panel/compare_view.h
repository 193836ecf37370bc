#pragma once
// All methods on the same frozen frame, one row each: what it costs, and what it finds of the true contacts.

#include "app/demo/status.h"

namespace app {

/// Draws the comparison along the lower edge of the area, while it is switched on, and returns the upper end of it:
/// what else stands in the area has to stay above. Between begin_frame() and end_frame() of the Gui.
float draw_compare(Widgets& widgets, Session& session, const SceneArea& area);

}  // namespace app
