#pragma once
// What the demo shows over the bodies.

#include "app/render/scene_view.h"
#include "app/session/session.h"
#include "app/ui/ui_state.h"

namespace app {

/// Boxes, cells and the like are of the present state: then so are the bodies.
bool whole_steps(const Session& session, const Overlays& shown);

/// Of what is chosen now; good until the next step.
OverlayRequest overlay_request(const Session& session, const UiState& ui);

}  // namespace app
