#include "app/demo/interface.h"

#include <cmath>

#include "app/demo/status.h"
#include "app/panel/compare_view.h"
#include "app/panel/help.h"
#include "app/panel/import_report.h"
#include "app/panel/panel.h"
#include "app/tour/card.h"
#include "app/view/surface_view.h"

namespace app {

bool Interface::panel_covers_scene(const UiState& ui, float scale) {
  return ui.panel && ImGui::GetIO().DisplaySize.x < (panel_width + least_scene_width) * scale;
}

/// A panel that covers the scene gives way to a tour.
bool Interface::shows_panel(const UiState& ui, float scale) {
  return ui.panel && !(ui.tour.open() && panel_covers_scene(ui, scale));
}

SceneArea Interface::beside_panel(const UiState& ui, float scale) {
  const bool beside = ui.panel && !panel_covers_scene(ui, scale);
  return {{beside ? panel_width * scale : 0.0f, 0.0f}, ImGui::GetIO().DisplaySize};
}

SceneArea Interface::tour_area(const UiState& ui, float scale) {
  SceneArea area = beside_panel(ui, scale);
  const bool wide = area.max.x - area.min.x >= (card_width + least_scene_width) * scale;
  if (wide)
    area.min.x = area.max.x - card_width * scale;
  else
    area.min.y = std::floor(0.45f * (area.min.y + area.max.y));
  return area;
}

SceneArea Interface::scene_area(const UiState& ui, float scale) {
  SceneArea area = beside_panel(ui, scale);
  if (!ui.tour.open()) return area;
  const SceneArea card = tour_area(ui, scale);
  (card.min.y > 0 ? area.max.y : area.max.x) = card.min.y > 0 ? card.min.y : card.min.x;
  return area;
}

void Interface::draw(Session& session, UiState& ui, float scale, double seconds, Recorder* recorder) {
  if (recorder) recorder->widgets.clear();
  Widgets widgets(scale, hover_, ui.sections, recorder);
  ui.import.follow(session);
  ui.tour.follow(session);
  if (shows_panel(ui, scale)) draw_panel(widgets, session, ui);
  const SceneArea area = scene_area(ui, scale);
  if (ui.tour.open())
    draw_tour(widgets, session, ui.tour, tour_area(ui, scale));
  else if (panel_covers_scene(ui, scale))
    draw_import_report(widgets, ui.import, area);
  else
    draw_over_scene(widgets, session, ui, area, seconds);
  if (ui.help) draw_help(widgets, area, ui.help);
  ui.list_open = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

void Interface::draw_over_scene(Widgets& widgets, Session& session, UiState& ui, const SceneArea& area,
                                double seconds) {
  SceneArea above = area;
  above.max.y = draw_compare(widgets, session, area);
  const float beside_table = ui.sweep ? SweepView::least_width : least_scene_width;
  const bool table_fits = area.max.x - area.min.x >= widgets.px(HashView::width + margin + beside_table) &&
                          above.max.y >= widgets.px(least_height_for_table);
  const bool table = ui.table && table_fits;
  SceneArea left_of_table = above;
  if (table) left_of_table.max.x -= widgets.px(HashView::width + margin);
  draw_caption(widgets, session, left_of_table, seconds);
  SceneArea below_status = above;
  below_status.min.y = draw_status(widgets, session, above, ui.light);
  draw_legends(widgets, session, draw_true_surfaces(widgets, session, below_status));
  if (table) hash_view_.draw(widgets, session, above, ui.table);
  if (ui.sweep) sweep_view_.draw(widgets, session, left_of_table, ui.sweep);
  draw_import_report(widgets, ui.import, left_of_table);
}

}  // namespace app
