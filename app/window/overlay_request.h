#pragma once
// What the demo asks the scene view to draw over the bodies.

#include "app/render/scene_view.h"
#include "app/session/session.h"
#include "app/ui/state/ui_state.h"

namespace app::window {

/// True if boxes, cells, areas or a bucket are shown. These belong to the present state, so the bodies must be drawn in
/// it too, not between two steps.
bool shows_present_state(const Session& session, const render::Overlays& shown);

/// Returns the missed contacts that the scene marks: those of the overlay, or those of the card. nullptr: none.
const std::vector<collide::Contact>* shown_misses(const Session& session, const ui::UiState& ui);

/// Returns the request for what is switched on and selected now. It is valid until the next step.
render::OverlayRequest overlay_request(const Session& session, const ui::UiState& ui);

/// Returns the labels in the scene: those of the tour, and the marks of the missed contacts if these are shown.
std::vector<render::SceneLabel> scene_labels(const Session& session, const ui::UiState& ui);

}  // namespace app::window
