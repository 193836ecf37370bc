#include "app/ui/views/views.h"

namespace app::ui {

void draw_guest_report(Widgets& w, const session::Guests& guests) {
  const std::string message = guests.message();
  if (message.empty()) return;
  const bool is_problem = !guests.asks() && !guests.loading();
  w.wrapped_text("Guest report", message, is_problem);
  if (guests.asks()) {
    if (w.button("Run", "Runs it in a process of its own, and again whenever the file changes.", w.px(80)))
      w.ask([](Session& s, UiState& ui) {
        s.guests.answer(true);
        ui.lower = LowerView::comparison;
      });
    ImGui::SameLine();
    if (w.button("Leave", "Does not run it.", w.px(80))) w.ask([](Session& s) { s.guests.answer(false); });
  }
  if (is_problem &&
      w.button("x###Close guest report", "Puts this away until the file changes.", ImGui::GetFrameHeight()))
    w.ask([](Session& s) { s.guests.dismiss(); });
}

}  // namespace app::ui
