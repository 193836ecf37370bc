#include "app/demo/interface.h"

#include "app/demo/status.h"
#include "app/panel/compare_view.h"
#include "app/panel/help.h"
#include "app/panel/panel.h"
#include "app/view/surface_view.h"

namespace app {

bool Interface::panel_covers_scene(const UiState& ui, float scale) {
  return ui.panel && ImGui::GetIO().DisplaySize.x < (panel_width + least_scene_width) * scale;
}

SceneArea Interface::scene_area(const UiState& ui, float scale) {
  const bool beside = ui.panel && !panel_covers_scene(ui, scale);
  return {{beside ? panel_width * scale : 0.0f, 0.0f}, ImGui::GetIO().DisplaySize};
}

void Interface::draw(Session& session, UiState& ui, float scale, double seconds, Recorder* recorder) {
  if (recorder) recorder->widgets.clear();
  Widgets widgets(scale, hover_, ui.sections, recorder);
  ui.import.follow(session);
  if (ui.panel) draw_panel(widgets, session, ui);
  const SceneArea area = scene_area(ui, scale);
  if (!panel_covers_scene(ui, scale)) draw_over_scene(widgets, session, ui, area, seconds);
  if (ui.help) draw_help(widgets, area, ui.help);
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
  const float status_end = draw_status(widgets, session, above);
  draw_legends(widgets, session, above, draw_true_surfaces(widgets, session, above, status_end));
  if (table) hash_view_.draw(widgets, session, above, ui.table);
  if (ui.sweep) sweep_view_.draw(widgets, session, left_of_table, ui.sweep);
}

}  // namespace app
