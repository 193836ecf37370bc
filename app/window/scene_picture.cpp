#include "app/window/scene_picture.h"

#include <algorithm>
#include <iterator>

#include "app/render/halves.h"
#include "app/render/miss_marks.h"
#include "app/render/palette.h"

namespace app::window {
namespace {

using session::Half;

/// Returns the missed contacts that a half shows; of two halves each what its own method misses.
const std::vector<collide::Contact>* missed_in(const ScenePicture& picture, const Session& session, Half half) {
  if (!picture.misses_of) return nullptr;
  if (const session::Beside* beside = session.simulation.beside()) return &beside->figures(half).missed();
  return session.comparison.missed_by(*picture.misses_of);
}

/// Returns the first false pair of the method whose missed contacts are shown.
std::optional<collide::Contact> false_in(const ScenePicture& picture, const Session& session) {
  if (!picture.misses_of || session.simulation.beside()) return std::nullopt;
  const compare::CompareRow* row = session.comparison.scored_row(*picture.misses_of);
  return row ? row->first_false : std::nullopt;
}

}  // namespace

ScenePicture scene_picture(const Session& session, const ui::UiState& ui, const engine::Camera& camera, float scale) {
  ScenePicture picture;
  picture.shown = ui.drawn_overlays(session);
  picture.bucket_cell = session.inspector.selected_cell();
  picture.selected_body = session.bodies.selected();
  picture.grab = grabbed(session.simulation);
  picture.bucket = session.inspector.selected_bucket();
  picture.world = session.simulation.revision();
  picture.highlight = ui.tour.highlight_revision();
  if (picture.shown.missed)
    picture.misses_of = session.comparison.choice.misses_of;
  else if (ui.marks_story() && !session.simulation.beside())
    picture.misses_of = compare::method_index(collide::paper_method);
  if (picture.misses_of) picture.misses = session.comparison.reports();
  if (session.simulation.beside() && !ui.tour.open()) {
    // A half that has stopped may lack bodies that have come since.
    const softbody::BodiesInMotion& second = session.simulation.world(Half::second);
    picture.ghost = ui.beside_as_ghost && second.bodies().first == session.world().bodies().first;
    if (!ui.beside_as_ghost) picture.line = ui.line;
    picture.shown.true_surfaces = true;  // what misses cost
  }
  if (picture.shown.true_surfaces) picture.surfaces = session.surfaces.reports() + session.surfaces_beside.reports();
  // What is found out about the present state is drawn with the bodies in it.
  const bool of_present = render::shows(picture.shown, render::OverlayBasis::present) || picture.bucket;
  picture.between = of_present ? 1.0f : between(session.simulation);
  picture.camera = camera;
  picture.scale = scale;
  return picture;
}

std::vector<HalfPicture> halves(const ScenePicture& picture, const engine::Viewport& whole) {
  if (!picture.line) return {{Half::first, whole, picture.camera}};
  std::vector<HalfPicture> parts;
  for (const engine::Viewport& part : render::side_by_side(whole, *picture.line)) {
    parts.push_back({parts.empty() ? Half::first : Half::second, part, picture.camera});
    // As if the halves were equal: so bodies have the same size in both, wherever the line is.
    render::SceneView::refit(parts.back().camera, whole.size, {whole.size.x / 2, whole.size.y});
  }
  return parts;
}

render::OverlayRequest overlay_request(const Session& session, const ui::Tour& tour, const ScenePicture& picture,
                                       Half half) {
  const session::DetectionInspector& inspector = half == Half::first ? session.inspector : session.inspector_beside;
  const session::SurfaceMonitor& surfaces = half == Half::first ? session.surfaces : session.surfaces_beside;
  render::OverlayRequest request;
  static_cast<render::OverlayChoice&>(request) = picture;
  request.missed = missed_in(picture, session, half);
  request.shown.missed = request.missed != nullptr;
  request.false_found = false_in(picture, session);
  if (picture.bucket) request.bucket = inspector.bucket();
  if (render::shows(request.shown, render::OverlayBasis::table) || request.bucket)
    request.debug = &inspector.shown_geometry();
  if (request.shown.areas) request.areas = inspector.search_areas();
  if (request.shown.surface_contacts) request.surface_contacts = inspector.surface_contacts();
  if (const softbody::World* world = session.simulation.simulated(half); world && request.shown.contacts)
    request.solid_contacts = softbody::solid_contacts(*world);
  if (picture.surfaces) request.marks = surfaces.report().marks;
  request.highlight = tour.highlight();
  if (picture.ghost) {
    request.ghost = &session.simulation.beside()->world();
    request.ghost_positions = drawn_meshes(session, picture.between, Half::second).shown;
  }
  return request;
}

render::DrawnMeshes drawn_meshes(const Session& session, float between, Half half) {
  return {session.simulation.world(half), session.simulation.before_last_step(half), between};
}

std::vector<render::SceneLabel> scene_labels(const Session& session, const ui::Tour& tour, const ScenePicture& picture,
                                             Half half) {
  std::vector<render::SceneLabel> labels;
  if (const render::Highlight* highlight = tour.highlight()) labels = highlight->labels;
  const render::DrawnPositions at = drawn_meshes(session, picture.between, half).shown;
  if (const auto* missed = missed_in(picture, session, half))
    std::ranges::copy(render::miss_marks(session.simulation.world(half), *missed, at), std::back_inserter(labels));
  if (const auto pair = false_in(picture, session))
    labels.push_back({0.5f * (at[pair->a] + at[pair->b]), "a false pair", render::contact_false_colour});
  return labels;
}

}  // namespace app::window
