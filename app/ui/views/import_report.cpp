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
  if (w.button("Import", "Each file joins the scene as a soft body.", w.px(80)))
    w.ask([](Session& s) { s.import.import_each(); });
  ImGui::SameLine();  // "Close" follows
}

}  // namespace

void draw_import_report(Widgets& w, const session::Import& import) {
  const bool asks = !import.question().empty();
  for (const session::Import::FileReport& report : import.report()) {
    for (const std::string& line : report.lines) w.wrapped_text("Import report", line, report.refused);
    if (&report != &import.report().back()) ImGui::Separator();
  }
  if (asks) draw_question(w, import);
  if (import.busy()) {
    w.wrapped_text("Import progress", import.progress());
    if (w.button("Cancel###Cancel import", "Reads no further, and forgets the files that wait.", w.px(80)))
      w.ask([](Session& s) { s.import.cancel(); });
  }
  if ((asks || (!import.report().empty() && !import.busy())) &&
      w.button("Close###Close import report", "Closes this report.", w.px(80)))
    w.ask([](Session& s) { s.import.dismiss_report(); });
}

}  // namespace app::ui
