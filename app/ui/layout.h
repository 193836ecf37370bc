#pragma once
// The layout of the user interface: where its parts stand and what is left for the scene.

#include <optional>
#include <string>

#include "app/session/session.h"
#include "app/ui/state/ui_state.h"
#include "app/ui/widgets/dock.h"

namespace app::ui {

inline constexpr float min_scene_width = 240;  // design pixels

struct Layout {
  bool panel_covers_scene = false;      // the window is too narrow for both
  bool cards = false;                   // the strip shows all that it has, not only messages
  std::optional<ScreenRect> panel;      // at the left edge
  std::optional<ScreenRect> strip;      // at the upper edge
  std::optional<ScreenRect> sidebar;    // at the right edge
  std::optional<ScreenRect> lower;      // at the lower edge, for UiState::lower
  std::optional<ScreenRect> time_line;  // between the scene and `lower`
  std::optional<ScreenRect> beside;     // between the scene and the time line, if there are two worlds
  std::optional<ScreenRect> tour;       // instead of sidebar, `lower` and time line
  ScreenRect scene;                     // the rest; all below the strip if the panel covers the scene
  std::string no_room_message;          // names a part that is switched on and has no room; else empty
};

/// What contents need, in ImGui units: known when they have been drawn.
struct Heights {
  float strip = 0, beside = 0;
};
/// Lays the parts out in ImGui's display.
Layout compute_layout(const Session& session, const UiState& ui, float scale, const Heights& heights);

}  // namespace app::ui
