#include "app/interface.h"

#include "app/help.h"
#include "app/panel.h"
#include "app/status.h"

namespace app {

SceneArea Interface::scene_area(const UiState& ui, float scale) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  return {{ui.panel ? std::min(panel_width * scale, display.x) : 0.0f, 0.0f}, display};
}

void Interface::draw(Session& session, UiState& ui, float scale, double seconds, Recorder* recorder) {
  if (recorder) recorder->widgets.clear();
  Widgets widgets(scale, recorder);
  const SceneArea area = scene_area(ui, scale);
  draw_caption(widgets, session, area, seconds);
  if (ui.panel) draw_panel(widgets, session, ui);
  draw_status(widgets, session, area);
  draw_legends(widgets, session, area);
  if (ui.table) hash_view_.draw(widgets, session, area, ui.table);
  if (ui.help) draw_help(widgets, area, ui.help);
}

}  // namespace app
