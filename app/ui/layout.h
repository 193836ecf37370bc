#pragma once
// Where the interface's parts stand, and what is left for the scene.

#include <optional>
#include <string>

#include "app/session/session.h"
#include "app/ui/ui_state.h"
#include "app/ui/widgets/dock.h"

namespace app {

inline constexpr float least_scene_width = 240;  // design pixels

struct Layout {
  bool panel_covers_scene = false;   // the window is too narrow for both
  std::optional<SceneArea> panel;    // at the left edge
  std::optional<SceneArea> column;   // at the right one: what the scene's colours mean, and the hash table
  std::optional<SceneArea> compare;  // at the lower one
  std::optional<SceneArea> tour;     // in place of the two
  SceneArea scene;                   // the rest, or all behind the panel that covers it
  std::string no_room;               // a sentence on what is switched on and finds no place here, or empty
};

/// For ImGui's display as it is.
Layout lay_out(const Session& session, const UiState& ui, float scale);

}  // namespace app
