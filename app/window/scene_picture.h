#pragma once
// What the demo's picture of the scene shows, as a value; and what the scene view draws it from.

#include "app/render/scene_view.h"
#include "app/session/session.h"
#include "app/ui/state/ui_state.h"
#include "engine/camera.h"

namespace app::window {

/// All that a picture of the scene depends on: pictures of equal values are equal. Numbers stand for what is too large
/// to compare, and change with it; nothing: it is not in the picture.
struct ScenePicture : render::OverlayChoice {
  std::optional<std::uint32_t> bucket;
  std::optional<std::size_t> misses_of;  // of this method, an index in collide::method_table()
  std::uint64_t world = 0, highlight = 0;
  std::optional<std::uint64_t> misses, surfaces;
  std::optional<float> line;  // two worlds side by side: the share of the width where the line between them lies
  bool ghost = false;         // the second world is drawn translucent over the first
  float between = 1;          // how far bodies are on the way from the step before to the present one
  engine::Camera camera;
  float scale = 1;  // of lines and points

  bool operator==(const ScenePicture&) const = default;
};

/// Returns the picture of what is switched on and selected now.
ScenePicture scene_picture(const Session& session, const ui::UiState& ui, const engine::Camera& camera, float scale);

/// A part of the picture that shows one world.
struct HalfPicture {
  session::Half half;
  engine::Viewport viewport;
  engine::Camera camera;  // the picture's, framed for the viewport
};
/// Returns the parts of a picture in this viewport, from left to right: one, or two side by side.
std::vector<HalfPicture> halves(const ScenePicture& picture, const engine::Viewport& whole);

/// Returns what a half is drawn from, for SceneView::draw(). It is valid until the next step.
render::OverlayRequest overlay_request(const Session& session, const ui::Tour& tour, const ScenePicture& picture,
                                       session::Half half);

/// Returns the positions at which the bodies of a half are, `between` the last step and the present; see
/// Simulation::between(). They are valid until the next step.
render::DrawnMeshes drawn_meshes(const Session& session, float between, session::Half half = session::Half::first);

/// Returns the labels in a half: those of the tour, and the marks of the missed contacts.
std::vector<render::SceneLabel> scene_labels(const Session& session, const ui::Tour& tour, const ScenePicture& picture,
                                             session::Half half);

}  // namespace app::window
