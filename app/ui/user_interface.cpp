#include "app/ui/user_interface.h"

#include <algorithm>

#include "app/ui/help.h"
#include "app/ui/panel/panel.h"
#include "app/ui/sidebar.h"
#include "app/ui/tour/tour_view.h"
#include "app/ui/views/compare_view.h"
#include "app/ui/views/import_report.h"
#include "app/ui/views/status.h"

namespace app::ui {

void UserInterface::draw(Session& session, UiState& ui, float scale, double seconds, WidgetRecorder* recorder) {
  if (recorder) recorder->widgets.clear();
  Widgets widgets(scale, mouse_, ui.sections, recorder);
  ui.import.update(session);
  sweep_view_.update();
  ui.tour.update(session, &ui.view);
  layout_ = compute_layout(session, ui, scale);
  if (layout_.panel) draw_panel(widgets, session, ui, *layout_.panel, layout_.panel_covers_scene);
  if (layout_.compare) draw_compare(widgets, session, ui.overlays.missed, *layout_.compare);
  if (layout_.sidebar) draw_sidebar(widgets, session, ui, hash_table_view_, *layout_.sidebar);
  if (layout_.tour)
    draw_tour(widgets, session, ui.tour, ui.overlays, *layout_.tour);
  else if (layout_.panel_covers_scene)
    draw_import_report(widgets, ui.import, layout_.scene);
  else
    draw_over_scene(widgets, session, ui, seconds);
  if (ui.help) draw_help(widgets, layout_.scene, ui.help);
  session.surfaces.on = ui.overlays.true_surfaces;
  ui.popup_open = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

double UserInterface::seconds_to_change(double seconds) const { return seconds_to_hint_change(seconds); }

void UserInterface::draw_over_scene(Widgets& widgets, Session& session, UiState& ui, double seconds) {
  const ScreenRect& area = layout_.scene;
  const float caption = draw_caption(widgets, session, area, seconds);
  ScreenRect below_status = area;
  below_status.min.y = draw_status(widgets, session, layout_.no_room_message, area, ui.coverage_explained);
  ScreenRect between = below_status;
  between.max.y = caption;
  if (!layout_.sidebar) draw_floating_legend(widgets, session, ui.overlays, below_status);
  if (ui.sweep) sweep_view_.draw(widgets, session, below_status, ui.sweep);
  draw_import_report(widgets, ui.import, between);
}

}  // namespace app::ui
