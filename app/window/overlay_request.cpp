#include "app/window/overlay_request.h"

namespace app {

bool shows_present_state(const Session& session, const Overlays& shown) {
  return shown.boxes || shown.cells || shown.areas || session.selected_bucket();
}

OverlayRequest overlay_request(const Session& session, const UiState& ui) {
  OverlayRequest request;
  request.shown = ui.overlays;
  request.bucket = session.bucket();
  request.bucket_cell = session.selected_cell();
  request.selected_body = session.selected_body();
  const bool needs_debug = request.shown.boxes || request.shown.cells || request.bucket;
  if (needs_debug) request.debug = &session.debug();
  if (request.shown.areas) request.areas = session.areas();
  request.missed = session.missed();
  if (request.shown.touches) request.touches = session.touches();
  request.marks = session.surfaces().report().marks;
  request.highlight = ui.tour.highlight();
  const Ghost* ghost = ui.tour.open() ? nullptr : session.ghost();
  if (ghost && !ghost->blown_up()) {
    request.ghost = &ghost->world();
    request.ghost_positions =
        ghost->drawn_positions(shows_present_state(session, ui.overlays) ? 1.0f : session.between());
  }
  return request;
}

}  // namespace app
