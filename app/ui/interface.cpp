#include "app/ui/interface.h"

#include "app/ui/column.h"
#include "app/ui/compare_view.h"
#include "app/ui/help.h"
#include "app/ui/import_report.h"
#include "app/ui/panel/panel.h"
#include "app/ui/status.h"
#include "app/ui/tour/card.h"

namespace app {

void Interface::draw(Session& session, UiState& ui, float scale, double seconds, Recorder* recorder) {
  if (recorder) recorder->widgets.clear();
  Widgets widgets(scale, hover_, ui.sections, recorder);
  ui.import.update(session);
  ui.tour.follow(session, &ui.view);
  layout_ = lay_out(session, ui, scale);
  if (layout_.panel) draw_panel(widgets, session, ui, *layout_.panel, layout_.panel_covers_scene);
  if (layout_.compare) draw_compare(widgets, session, ui.overlays.missed, *layout_.compare);
  if (layout_.column) draw_column(widgets, session, ui, hash_view_, *layout_.column);
  if (layout_.tour)
    draw_tour(widgets, session, ui.tour, ui.overlays, *layout_.tour);
  else if (layout_.panel_covers_scene)
    draw_import_report(widgets, ui.import, layout_.scene);
  else
    draw_over_scene(widgets, session, ui, seconds);
  if (ui.help) draw_help(widgets, layout_.scene, ui.help);
  session.judges_surfaces = ui.overlays.true_surfaces;
  ui.list_open = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

void Interface::draw_over_scene(Widgets& widgets, Session& session, UiState& ui, double seconds) {
  const SceneArea& area = layout_.scene;
  const float caption = draw_caption(widgets, session, area, seconds);
  SceneArea below_status = area;
  below_status.min.y = draw_status(widgets, session, layout_.no_room, area, ui.light);
  SceneArea between = below_status;
  between.max.y = caption;
  if (!layout_.column) draw_legend_plate(widgets, session, ui.overlays, below_status);
  if (ui.sweep) sweep_view_.draw(widgets, session, below_status, ui.sweep);
  draw_import_report(widgets, ui.import, between);
}

}  // namespace app
