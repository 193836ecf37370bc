#include "app/ui/layout.h"

#include <cmath>

#include "app/ui/column.h"
#include "app/ui/compare_view.h"
#include "app/ui/panel/panel.h"
#include "app/ui/sweep_view.h"

namespace app {
namespace {

constexpr float tour_width = 340;     // design pixels
constexpr float least_height = 200;   // of the scene above the comparison
constexpr float status_height = 150;  // of what draw_status() takes of it, mostly

float width_of(const SceneArea& area) { return area.max.x - area.min.x; }

/// Cuts the card of the tour off: at the right, or below where the window is narrow.
SceneArea cut_tour(SceneArea& scene, float scale) {
  SceneArea card = scene;
  if (width_of(scene) >= (tour_width + least_scene_width) * scale)
    scene.max.x = card.min.x = scene.max.x - tour_width * scale;
  else
    scene.max.y = card.min.y = std::floor(0.45f * (scene.min.y + scene.max.y));
  return card;
}

}  // namespace

Layout lay_out(const Session& session, const UiState& ui, float scale) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  Layout layout;
  layout.scene = {{0, 0}, display};
  SceneArea& scene = layout.scene;
  layout.panel_covers_scene = ui.panel && display.x < (panel_width + least_scene_width) * scale;
  // A panel that covers the scene gives way to a tour.
  if (ui.panel && !(ui.tour.open() && layout.panel_covers_scene))
    layout.panel = {{0, 0}, {panel_width * scale, display.y}};
  if (ui.panel && !layout.panel_covers_scene) scene.min.x = panel_width * scale;
  if (ui.tour.open()) {
    layout.tour = cut_tour(scene, scale);
    return layout;
  }
  if (layout.panel_covers_scene) return layout;
  const float compare_top = display.y - compare_height(width_of(scene), scale);
  const float above = ui.sweep ? status_height + SweepView::least_height : least_height;
  if (session.compare.on && compare_top >= above * scale) {
    layout.compare = {{scene.min.x, compare_top}, display};
    scene.max.y = compare_top;
  } else if (session.compare.on) {
    layout.no_room = "No room for the comparison: enlarge the window";
    layout.no_room += ui.sweep ? " or close the error against run time (E)." : ".";
  }
  if (has_column(session, ui) && width_of(scene) >= (column_width + least_scene_width) * scale) {
    layout.column = {{scene.max.x - column_width * scale, scene.min.y}, scene.max};
    scene.max.x = layout.column->min.x;
  } else if (ui.table && layout.no_room.empty()) {
    layout.no_room = "No room for the hash table: enlarge the window";
    layout.no_room += ui.panel ? " or hide the panel (H)." : ".";
  }
  return layout;
}

}  // namespace app
