#include "app/ui/layout.h"

#include <algorithm>
#include <cmath>

#include "app/ui/panel/panel.h"
#include "app/ui/parts.h"
#include "app/ui/strip.h"
#include "app/ui/views/sweep_view.h"
#include "app/ui/views/views.h"

namespace app::ui {
namespace {

// All in design pixels.
constexpr float tour_width = 340;
constexpr float min_scene_height = 200;
constexpr std::size_t min_compare_rows = 5;  // without scrolling

float width_of(const ScreenRect& area) { return area.max.x - area.min.x; }

/// Cuts the tour's area off the scene: at the right, or below if the window is narrow.
ScreenRect cut_tour(ScreenRect& scene, float scale) {
  ScreenRect tour = scene;
  if (width_of(scene) >= (tour_width + min_scene_width) * scale)
    scene.max.x = tour.min.x = scene.max.x - tour_width * scale;
  else
    scene.max.y = tour.min.y = std::floor(0.45f * (scene.min.y + scene.max.y));
  return tour;
}

/// Returns the height of what stands below the scene, at most `room`; more if that is too little.
float lower_height(const Session& session, LowerView view, const ScreenRect& scene, float room, float scale) {
  const auto rows = static_cast<std::size_t>(std::ranges::count(session.comparison.shown_methods(), true));
  const auto fit = [&](float least, float wanted) {
    return std::clamp(std::floor(room), least, std::max(least, wanted));
  };
  if (view == LowerView::comparison) {
    const auto height = [&](std::size_t count) { return compare_height(count, width_of(scene), scale); };
    return fit(height(std::min(rows, min_compare_rows)), height(rows));
  }
  return fit(SweepView::min_height * scale, std::floor(scale * SweepView::preferred_height(rows, scene.max.y / scale)));
}

}  // namespace

Layout compute_layout(const Session& session, const UiState& ui, float scale, const Heights& heights) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float line = time_line_height(scale);
  const bool panel = ui.panel && !ui.clean;
  Layout layout;
  layout.scene = {{0, 0}, display};
  ScreenRect& scene = layout.scene;
  layout.panel_covers_scene = panel && display.x < (panel_width + min_scene_width) * scale;
  layout.cards = !ui.clean && !ui.tour.open() && !layout.panel_covers_scene;
  if (panel && !layout.panel_covers_scene) scene.min.x = panel_width * scale;
  if (layout.cards || has_messages(session)) {
    const float most = std::max(display.y - min_scene_height * scale - line, 0.0f);
    layout.strip = {scene.min, {scene.max.x, std::ceil(std::min(heights.strip, most))}};
    scene.min.y = layout.strip->max.y;
  }
  // A panel that covers the scene is hidden during the tour.
  if (panel && !(ui.tour.open() && layout.panel_covers_scene))
    layout.panel = {{0, layout.panel_covers_scene ? scene.min.y : 0}, {panel_width * scale, display.y}};
  if (ui.clean) return layout;
  if (ui.tour.open()) {
    layout.tour = cut_tour(scene, scale);
    return layout;
  }
  if (layout.panel_covers_scene) return layout;
  if (ui.lower != LowerView::none) {
    const float beside = session.simulation.beside() ? heights.beside : 0;
    const float room = display.y - scene.min.y - min_scene_height * scale - line - beside;
    const float height = lower_height(session, ui.lower, scene, room, scale), top = display.y - height;
    if (height <= room)
      layout.lower = {{scene.min.x, top}, display};
    else
      layout.no_room_message = ui.lower == LowerView::comparison
                                   ? "No room for the comparison: enlarge the window."
                                   : "No room for error against run time: enlarge the window.";
  }
  if (layout.lower) scene.max.y = layout.lower->min.y;
  layout.time_line = {{scene.min.x, scene.max.y - line}, scene.max};
  scene.max.y -= line;
  if (session.simulation.beside()) {
    layout.beside = {{scene.min.x, scene.max.y - heights.beside}, scene.max};
    scene.max.y = layout.beside->min.y;
  }
  if (has_sidebar(session, ui) && width_of(scene) >= (sidebar_width + min_scene_width) * scale) {
    layout.sidebar = {{scene.max.x - sidebar_width * scale, scene.min.y}, scene.max};
    scene.max.x = layout.sidebar->min.x;
  } else if (ui.hash_table && layout.no_room_message.empty()) {
    layout.no_room_message = "No room for the hash table: enlarge the window";
    layout.no_room_message += ui.panel ? " or hide the panel (H)." : ".";
  }
  return layout;
}

}  // namespace app::ui
