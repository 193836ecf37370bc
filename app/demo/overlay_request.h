#pragma once
// What the demo shows over the bodies.

#include "app/demo/session.h"
#include "app/demo/ui_state.h"
#include "app/view/scene_view.h"

namespace app {

/// Boxes, cells and the like are of the present state: then so are the bodies.
bool whole_steps(const Session& session);

/// Of what is chosen now; good until the next step.
OverlayRequest overlay_request(const Session& session, const UiState& ui);

}  // namespace app
