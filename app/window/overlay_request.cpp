#include "app/window/overlay_request.h"

#include <algorithm>
#include <iterator>

#include "app/render/miss_marks.h"

namespace app::window {

bool shows_present_state(const Session& session, const render::Overlays& shown) {
  return shown.boxes || shown.cells || shown.areas || session.inspector.selected_bucket();
}

const std::vector<collide::Contact>* shown_misses(const Session& session, const ui::UiState& ui) {
  if (ui.overlays.missed) return session.comparison.missed();
  return ui.marks_story() ? session.comparison.missed_by(compare::method_index(collide::paper_method)) : nullptr;
}

render::OverlayRequest overlay_request(const Session& session, const ui::UiState& ui) {
  render::OverlayRequest request;
  request.shown = ui.drawn_overlays(session);
  request.missed = shown_misses(session, ui);
  request.shown.missed = request.missed != nullptr;
  request.bucket = session.inspector.bucket();
  request.bucket_cell = session.inspector.selected_cell();
  request.selected_body = session.bodies.selected();
  const bool needs_debug = request.shown.boxes || request.shown.cells || request.bucket;
  if (needs_debug) request.debug = &session.inspector.shown_geometry();
  if (request.shown.areas) request.areas = session.inspector.search_areas();
  if (request.shown.surface_contacts) request.surface_contacts = session.inspector.surface_contacts();
  if (const softbody::World* world = session.simulated(); world && request.shown.contacts)
    request.solid_contacts = softbody::solid_contacts(*world);
  request.grab = session.simulation.grabbed();
  request.marks = session.surfaces.report().marks;
  request.highlight = ui.tour.highlight();
  const session::Ghost& ghost = session.ghost();
  if (!ui.tour.open() && ghost.world() && !ghost.blown_up()) {
    request.ghost = ghost.world();
    request.ghost_positions =
        ghost.drawn_positions(shows_present_state(session, ui.overlays) ? 1.0f : session.simulation.between());
  }
  return request;
}

std::vector<render::SceneLabel> scene_labels(const Session& session, const ui::UiState& ui) {
  std::vector<render::SceneLabel> labels;
  if (const render::Highlight* highlight = ui.tour.highlight()) labels = highlight->labels;
  if (const auto* missed = shown_misses(session, ui))
    std::ranges::copy(render::miss_marks(session.world(), *missed,
                                         session.simulation.drawn(shows_present_state(session, ui.overlays)).shown),
                      std::back_inserter(labels));
  return labels;
}

}  // namespace app::window
