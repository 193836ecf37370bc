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
  std::optional<std::uint64_t> misses, surfaces, ghost;
  float between = 1;  // how far bodies are on the way from the step before to the present one
  engine::Camera camera;
  float scale = 1;  // of lines and points

  bool operator==(const ScenePicture&) const = default;
};

/// Returns the picture of what is switched on and selected now.
ScenePicture scene_picture(const Session& session, const ui::UiState& ui, const engine::Camera& camera, float scale);

/// Returns what the picture is drawn from, for SceneView::draw(). It is valid until the next step.
render::OverlayRequest overlay_request(const Session& session, const ui::Tour& tour, const ScenePicture& picture);

/// Returns the positions at which bodies are in the picture. They are valid until the next step.
render::DrawnMeshes drawn_meshes(const Session& session, const ScenePicture& picture);

/// Returns the labels in the picture: those of the tour, and the marks of the missed contacts.
std::vector<render::SceneLabel> scene_labels(const Session& session, const ui::Tour& tour, const ScenePicture& picture);

}  // namespace app::window
