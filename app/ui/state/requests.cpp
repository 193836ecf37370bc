#include "app/ui/state/requests.h"

#include "app/ui/state/ui_state.h"

namespace app::ui {

std::vector<WindowTask> carry_out(const Requests& requests, session::Session& session, UiState& ui) {
  std::vector<WindowTask> for_window;
  for (const Request& request : requests)
    if (const auto* task = std::get_if<WindowTask>(&request))
      for_window.push_back(*task);
    else
      std::get<0>(request)(session, ui);
  const Tour::Camera camera = ui.tour.update(session, &ui.view);
  if (camera.overview) for_window.push_back(WindowTask::show_as_before_tour);
  if (camera.framing) for_window.push_back(WindowTask::show_highlight);
  session.comparison.choice.on = ui.lower == LowerView::comparison;
  session.comparison.choice.with_paper = ui.marks_story() || (ui.panel && !session.world().method().uses_hash);
  session.comparison.choice.with_misses = ui.overlays.missed;
  session.surfaces.on = ui.overlays.true_surfaces;
  return for_window;
}

}  // namespace app::ui
