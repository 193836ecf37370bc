#include "app/interface.h"

#include "app/help.h"
#include "app/panel.h"
#include "app/status.h"

namespace app {

SceneArea Interface::scene_area(const UiState& ui, float scale) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const bool beside = ui.panel && display.x >= (panel_width + least_scene_width) * scale;
  return {{beside ? panel_width * scale : 0.0f, 0.0f}, display};
}

void Interface::draw(Session& session, UiState& ui, float scale, double seconds, Recorder* recorder) {
  if (recorder) recorder->widgets.clear();
  Widgets widgets(scale, hover_, recorder);
  const SceneArea area = scene_area(ui, scale);
  SceneArea left_of_table = area;
  if (ui.table) left_of_table.max.x -= widgets.px(HashView::width);
  draw_caption(widgets, session, left_of_table, seconds);
  if (ui.panel) draw_panel(widgets, session, ui);
  draw_legends(widgets, session, area, draw_status(widgets, session, area));
  if (ui.table) hash_view_.draw(widgets, session, area, ui.table);
  if (ui.help) draw_help(widgets, area, ui.help);
}

}  // namespace app
