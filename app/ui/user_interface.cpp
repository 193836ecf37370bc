#include "app/ui/user_interface.h"

#include <algorithm>

#include "app/ui/help.h"
#include "app/ui/panel/panel.h"
#include "app/ui/sidebar.h"
#include "app/ui/time_line.h"
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
  session.comparison.choice.on = ui.lower == LowerView::comparison;
  session.comparison.choice.shows_misses = ui.shows_misses();
  session.surfaces.on = ui.overlays.true_surfaces;
  layout_ = compute_layout(session, ui, scale);
  if (layout_.panel) draw_panel(widgets, session, ui, *layout_.panel, layout_.panel_covers_scene);
  if (layout_.lower) draw_lower(widgets, session, ui, *layout_.lower);
  if (layout_.time_line) draw_time_line(widgets, session, *layout_.time_line);
  if (layout_.sidebar) draw_sidebar(widgets, session, ui, hash_table_view_, *layout_.sidebar);
  if (layout_.tour)
    draw_tour(widgets, session, ui.tour, ui.overlays, *layout_.tour);
  else if (layout_.panel_covers_scene)
    draw_import_report(widgets, ui.import, layout_.scene);
  else if (!ui.clean)
    draw_over_scene(widgets, session, ui, seconds);
  if (ui.help) draw_help(widgets, layout_.scene, ui.help);
  ui.popup_open = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

double UserInterface::seconds_to_change(double seconds) const { return seconds_to_hint_change(seconds); }

void UserInterface::draw_lower(Widgets& widgets, Session& session, UiState& ui, const ScreenRect& area) {
  bool open = true;
  if (ui.lower == LowerView::comparison)
    draw_compare(widgets, session, ui.overlays.missed, open, area);
  else
    sweep_view_.draw(widgets, session, area, open);
  if (!open) ui.lower = LowerView::none;
}

void UserInterface::draw_over_scene(Widgets& widgets, Session& session, UiState& ui, double seconds) {
  ScreenRect free = layout_.scene;
  free.max.y = draw_caption(widgets, session, free, seconds);
  draw_story(widgets, session, ui, free);
  if (ui.lights) free.min.y = draw_status(widgets, session, lights_, free, ui.coverage_explained, ui.lights);
  free.min.y = draw_notices(widgets, session, layout_.no_room_message, free);
  if (!layout_.sidebar) draw_floating_legend(widgets, session, ui.overlays, free);
  draw_import_report(widgets, ui.import, free);
}

/// Draws the card at the upper edge, unless the lights leave no room there. The views below the scene say the same.
void UserInterface::draw_story(Widgets& widgets, Session& session, UiState& ui, const ScreenRect& area) {
  if (!ui.story || layout_.lower) return;
  const bool beside = !ui.lights || area.max.x - area.min.x >= widgets.px(2 * box_width + 36);
  switch (story_.draw(widgets, session, area, !beside)) {
    case StoryCard::Action::close:
      return ui.set_story(false);
    case StoryCard::Action::explain:
      return ui.tour.start(session, ui.overlays, miss_step);
    case StoryCard::Action::none:
      return;
  }
}

}  // namespace app::ui
