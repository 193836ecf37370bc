#include "app/ui/state/requests.h"

#include <utility>

#include "app/ui/state/ui_state.h"

namespace app::ui {

std::vector<WindowTask> carry_out(const Requests& requests, session::Session& session, UiState& ui) {
  std::vector<WindowTask> for_window;
  const bool had_sweep = ui.lower == LowerView::sweep && !session.sweep().scene.empty();
  for (const Request& request : requests)
    if (const auto* task = std::get_if<WindowTask>(&request))
      for_window.push_back(*task);
    else
      std::get<0>(request)(session, ui);
  const Tour::Camera camera = ui.tour.update(session, &ui.view);
  if (camera.overview) for_window.push_back(WindowTask::show_as_before_tour);
  if (camera.framing) for_window.push_back(WindowTask::show_highlight);
  if (!session.simulation.clock.paused) ui.once_compared.reset();  // that frame is gone
  if (ui.once_compared && session.comparison.report().id == session.simulation.revision())
    for_window.push_back(*std::exchange(ui.once_compared, std::nullopt));
  if (ui.lower == LowerView::sweep && !had_sweep && !session.sweep_worker.knows(session.world()))
    session.sweep_worker.start(session.world(), session.comparison.shown_methods());
  session.comparison.choice.on = ui.lower == LowerView::comparison;
  session.comparison.choice.with_paper = ui.marks_story() || (ui.panel && !session.world().method().uses_hash);
  session.comparison.choice.with_misses = ui.overlays.missed;
  session.price.on = ui.shows_story();
  session.surfaces_beside.on = session.simulation.beside() != nullptr;
  session.surfaces.on = ui.overlays.true_surfaces || session.surfaces_beside.on;
  return for_window;
}

}  // namespace app::ui
