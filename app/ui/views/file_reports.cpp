// What has become of the files that the user gave.

#include "app/ui/views/views.h"

namespace app::ui {
namespace {

/// Draws the question whether files are frames to play or bodies to import.
void draw_question(Widgets& w, const session::Import& import) {
  w.wrapped_text("Import question", import.question());
  if (w.button("Play",
               "The frames run in place of the scene, and nothing is simulated. Undo (Ctrl+Z) brings the scene back.",
               w.px(80)))
    w.ask([](Session& s) { s.import.play(); });
  ImGui::SameLine();
  if (w.button("Import", "All files together, as soft bodies in a scene of their own.", w.px(80)))
    w.ask([](Session& s) { s.import.import_each(); });
}

/// Draws a button behind what was drawn last if it fits into the line, else below.
bool button_behind(Widgets& w, const char* label, const char* tooltip, float width) {
  const float end = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
  if (ImGui::GetItemRectMax().x + ImGui::GetStyle().ItemSpacing.x + width <= end) ImGui::SameLine();
  return w.button(label, tooltip, width);
}

}  // namespace

void draw_import_report(Widgets& w, const session::Import& import) {
  const bool asks = !import.question().empty();
  for (const session::Import::FileReport& report : import.report()) {
    w.wrapped_text("Import report", report.text, report.refused);
    if (&report != &import.report().back()) ImGui::Separator();
  }
  if (asks) draw_question(w, import);
  if (import.busy()) {
    w.wrapped_text("Import progress", import.progress());
    if (w.button("Cancel###Cancel import", "Reads no further, and forgets the files that wait.", w.px(80)))
      w.ask([](Session& s) { s.import.cancel(); });
  }
  if (import.can_join() && !import.busy() &&
      button_behind(w, "Into the scene before", "Lets the mesh fall in the scene that was shown before it.", w.px(150)))
    w.ask([](Session& s) { s.import.join_scene_before(); });
  if ((asks || (!import.report().empty() && !import.busy())) &&
      button_behind(w, "x###Close import report", "Closes this report.", ImGui::GetFrameHeight()))
    w.ask([](Session& s) { s.import.dismiss_report(); });
}

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
      button_behind(w, "x###Close guest report", "Puts this away until the file changes.", ImGui::GetFrameHeight()))
    w.ask([](Session& s) { s.guests.dismiss(); });
}

}  // namespace app::ui
