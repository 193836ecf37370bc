#include "app/ui/user_interface.h"

#include <algorithm>
#include <utility>

#include "app/ui/panel/panel.h"
#include "app/ui/parts.h"
#include "app/ui/views/views.h"

namespace app::ui {

Requests UserInterface::draw(const Session& session, const UiState& ui, float scale, WidgetRecorder* recorder) {
  if (recorder) *recorder = {};
  Requests requests;
  Widgets widgets(scale, input_, ui.sections, requests, recorder);
  layout_ = compute_layout(session, ui, scale, {strip_.height(), beside_height_});
  if (layout_.strip) strip_.draw(widgets, session, ui, layout_);
  if (layout_.panel) draw_panel(widgets, session, ui, *layout_.panel, layout_.panel_covers_scene);
  if (layout_.lower && ui.lower == LowerView::comparison)
    draw_compare(widgets, session, ui, *layout_.lower);
  else if (layout_.lower)
    sweep_view_.draw(widgets, session, *layout_.lower);
  // It only grows, so that the scene does not jump with the length of texts.
  beside_height_ =
      layout_.beside ? std::max(beside_height_, draw_beside(widgets, session, ui, *layout_.beside, layout_.scene)) : 0;
  if (layout_.time_line) draw_time_line(widgets, session, *layout_.time_line);
  if (layout_.sidebar) draw_sidebar(widgets, session, ui, *layout_.sidebar);
  show_field_problem(widgets);
  if (layout_.tour) draw_tour(widgets, session, ui.tour, *layout_.tour);
  if (ui.help) draw_help(widgets, layout_.scene);
  const bool popup_open = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
  if (popup_open != ui.popup_open) widgets.ask([popup_open](UiState& state) { state.popup_open = popup_open; });
  return requests;
}

void UserInterface::show_field_problem(Widgets& widgets) {
  const auto problem = std::exchange(input_.field_problem, std::nullopt);
  if (!problem) return;
  widgets.ask([now = *problem, before = field_problem_](Session& session) {
    session::Notice& notice = session.simulation.notice;
    if (!now.empty())
      notice.set(now);
    else if (notice.text() == before)
      notice.clear();
  });
  field_problem_ = *problem;
}

}  // namespace app::ui
