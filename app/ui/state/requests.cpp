#include "app/ui/state/requests.h"

#include "app/ui/state/ui_state.h"

namespace app::ui {

std::vector<WindowRequest> carry_out(const Requests& requests, session::Session& session, UiState& ui) {
  std::vector<WindowRequest> for_window;
  for (const Request& request : requests)
    if (const auto* of_window = std::get_if<WindowRequest>(&request))
      for_window.push_back(*of_window);
    else
      std::get<0>(request)(session, ui);
  if (const auto joined = session.import.update())
    for_window.push_back({WindowTask::keep_in_sight, joined->centre, joined->radius});
  const Tour::Camera camera = ui.tour.update(session, &ui.view);
  if (camera.overview) for_window.push_back({WindowTask::show_as_before_tour});
  if (camera.framing) for_window.push_back({WindowTask::frame_highlight});
  session.comparison.choice.on = ui.lower == LowerView::comparison;
  session.comparison.choice.with_paper = ui.marks_story();
  session.comparison.choice.with_misses = ui.overlays.missed;
  session.surfaces.on = ui.overlays.true_surfaces;
  return for_window;
}

}  // namespace app::ui
