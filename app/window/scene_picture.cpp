#include "app/window/scene_picture.h"

#include <algorithm>
#include <iterator>

#include "app/render/miss_marks.h"

namespace app::window {
namespace {

const std::vector<collide::Contact>* missed_in(const ScenePicture& picture, const Session& session) {
  return picture.misses_of ? session.comparison.missed_by(*picture.misses_of) : nullptr;
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
  else if (ui.marks_story())
    picture.misses_of = compare::method_index(collide::paper_method);
  if (picture.misses_of) picture.misses = session.comparison.reports();
  if (picture.shown.true_surfaces) picture.surfaces = session.surfaces.reports();
  if (!ui.tour.open() && session.ghost().world() && !session.ghost().blown_up())
    picture.ghost = session.ghost().revision();
  // What is found out about the present state is drawn with the bodies in it.
  const bool of_present = render::shows(picture.shown, render::OverlayBasis::present) || picture.bucket;
  picture.between = of_present ? 1.0f : session.simulation.between();
  picture.camera = camera;
  picture.scale = scale;
  return picture;
}

render::OverlayRequest overlay_request(const Session& session, const ui::Tour& tour, const ScenePicture& picture) {
  render::OverlayRequest request;
  static_cast<render::OverlayChoice&>(request) = picture;
  request.missed = missed_in(picture, session);
  request.shown.missed = request.missed != nullptr;
  if (picture.bucket) request.bucket = session.inspector.bucket();
  if (render::shows(request.shown, render::OverlayBasis::table) || request.bucket)
    request.debug = &session.inspector.shown_geometry();
  if (request.shown.areas) request.areas = session.inspector.search_areas();
  if (request.shown.surface_contacts) request.surface_contacts = session.inspector.surface_contacts();
  if (const softbody::World* world = session.simulated(); world && request.shown.contacts)
    request.solid_contacts = softbody::solid_contacts(*world);
  if (picture.surfaces) request.marks = session.surfaces.report().marks;
  request.highlight = tour.highlight();
  if (picture.ghost) {
    request.ghost = session.ghost().world();
    request.ghost_positions = {request.ghost->positions(), session.ghost().before_last_step(), picture.between};
  }
  return request;
}

render::DrawnMeshes drawn_meshes(const Session& session, const ScenePicture& picture) {
  return {session.world(), session.simulation.before_last_step(), picture.between};
}

std::vector<render::SceneLabel> scene_labels(const Session& session, const ui::Tour& tour,
                                             const ScenePicture& picture) {
  std::vector<render::SceneLabel> labels;
  if (const render::Highlight* highlight = tour.highlight()) labels = highlight->labels;
  if (const auto* missed = missed_in(picture, session))
    std::ranges::copy(render::miss_marks(session.world(), *missed, drawn_meshes(session, picture).shown),
                      std::back_inserter(labels));
  return labels;
}

}  // namespace app::window
