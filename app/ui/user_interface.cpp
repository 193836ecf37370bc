#include "app/ui/user_interface.h"

#include <utility>

#include "app/ui/panel/panel.h"
#include "app/ui/parts.h"
#include "app/ui/tour/tour_view.h"
#include "app/ui/views/views.h"

namespace app::ui {

void UserInterface::draw(Session& session, UiState& ui, float scale, double seconds, WidgetRecorder* recorder) {
  if (recorder) *recorder = {};
  Widgets widgets(scale, input_, ui.sections, recorder);
  ui.import.update(session);
  sweep_view_.update();
  ui.tour.update(session, &ui.view);
  session.comparison.choice.on = ui.lower == LowerView::comparison;
  session.comparison.choice.with_paper = ui.marks_story();
  session.comparison.choice.with_misses = ui.overlays.missed;
  session.surfaces.on = ui.overlays.true_surfaces;
  if (!ui.hash_table && std::exchange(had_hash_table_, ui.hash_table)) session.inspector.select_bucket(std::nullopt);
  had_hash_table_ = ui.hash_table;
  layout_ = compute_layout(session, ui, scale);
  if (layout_.panel) draw_panel(widgets, session, ui, *layout_.panel, layout_.panel_covers_scene);
  bool open = true;
  if (layout_.lower && ui.lower == LowerView::comparison)
    draw_compare(widgets, session, ui.overlays.missed, open, *layout_.lower);
  else if (layout_.lower)
    sweep_view_.draw(widgets, session, *layout_.lower, open);
  if (!open) ui.lower = LowerView::none;
  if (layout_.time_line) draw_time_line(widgets, session, *layout_.time_line);
  if (layout_.sidebar) draw_sidebar(widgets, session, ui, hash_table_view_, *layout_.sidebar);
  show_field_problem(session.simulation.notice);
  if (layout_.tour)
    draw_tour(widgets, session, ui.tour, ui.overlays, *layout_.tour);
  else if (!ui.clean && !layout_.panel_covers_scene)
    draw_over_scene(widgets, session, ui, seconds);
  else
    draw_notices(widgets, session, {}, layout_.scene);
  if (!layout_.tour && layout_.panel_covers_scene) draw_import_report(widgets, session, ui.import, layout_.scene);
  if (ui.help) draw_help(widgets, layout_.scene, ui.help);
  ui.popup_open = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

void UserInterface::show_field_problem(session::Notice& notice) {
  const auto problem = std::exchange(input_.field_problem, std::nullopt);
  if (!problem) return;
  if (!problem->empty())
    notice.set(*problem);
  else if (notice.text() == field_problem_)
    notice.clear();
  field_problem_ = *problem;
}

void UserInterface::draw_over_scene(Widgets& widgets, Session& session, UiState& ui, double seconds) {
  ScreenRect free = layout_.scene;
  free.max.y = draw_caption(widgets, session, free, seconds);
  ScreenRect beside = free;
  if (ui.lights) free.min.y = draw_status(widgets, session, lights_, free, ui.coverage_explained, ui.lights);
  if (ui.shows_story()) {
    const bool both_fit = free.max.x - free.min.x >= widgets.px(2 * min_box_width + 3 * box_margin);
    StoryCard::Action action{};
    const float end = story_.draw(widgets, session, both_fit ? beside : free, action);
    if (!both_fit) free.min.y = end;
    if (action == StoryCard::Action::close) ui.set_story(false);
    if (action == StoryCard::Action::explain) ui.tour.start(session, ui.overlays, miss_step);
  }
  free.min.y = draw_notices(widgets, session, layout_.no_room_message, free);
  if (!layout_.sidebar) draw_floating_legend(widgets, session, ui.drawn_overlays(session), free);
  draw_import_report(widgets, session, ui.import, free);
}

}  // namespace app::ui
