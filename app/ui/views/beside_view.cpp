// Two worlds side by side: the strip below the scene with what each has cost and missed, and the line between them.

#include <algorithm>

#include <fmt/core.h>

#include "app/compare/difference.h"
#include "app/render/halves.h"
#include "app/render/palette.h"
#include "app/ui/state/ui_state.h"
#include "app/ui/views/views.h"

namespace app::ui {
namespace {

using session::Half;

constexpr int lines = 3;  // of the strip, without the line of its titles

std::string contacts_text(const compare::RunTotals& run) {
  if (run.true_contacts == 0) return "no contacts yet";
  if (run.missed == 0) return fmt::format("missed none of {} contacts", grouped(run.true_contacts));
  return fmt::format("missed {} of {} contacts, {:.2g} %", grouped(run.missed), grouped(run.true_contacts),
                     100 * double(run.missed) / double(run.true_contacts));
}

std::string inside_text(const compare::RunTotals& run) {
  const auto vertices = [](std::size_t count, double depth) {
    return fmt::format("{} {}, {:.2f} m deep", grouped(count), count == 1 ? "vertex" : "vertices", depth);
  };
  if (run.most_inside == 0) return "no vertex inside another body so far";
  const std::string most = "at most " + vertices(run.most_inside, run.deepest);
  if (run.inside == 0) return "inside other bodies: none now, " + most;
  return "inside other bodies: " + vertices(run.inside, run.depth) + "; " + most;
}

std::string cost_text(const compare::RunTotals& run) {
  return run.frames == 0 ? "detection: not timed yet"
                         : fmt::format("detection {:.3g} ms a frame", run.detect_ms / run.frames);
}

void draw_text(Widgets& w, std::string_view label, const std::string& text, bool bad) {
  if (bad) ImGui::PushStyleColor(ImGuiCol_Text, to_imgui(render::contact_missed_colour));
  ImGui::TextUnformatted(text.c_str());
  if (bad) ImGui::PopStyleColor();
  w.register_item(label, text);
}

void draw_half(Widgets& w, const Session& session, Half half) {
  const session::Beside& beside = *session.simulation.beside();
  const compare::RunTotals& run = beside.figures(half).totals();
  const softbody::World& world = *session.simulation.simulated(half);
  const bool second = half == Half::second;
  const std::string side = second ? "Right" : "Left";
  const std::string title = beside.difference().text({world.scene(), world.integrator_choice()});
  if (ImGui::RadioButton(fmt::format("{}: {}###{} half", side, title, side).c_str(), session.simulation.edits == half))
    w.ask([half](Session& s) { s.simulation.edits = half; });
  w.register_item(side + " half", "The panel shows and changes the settings of this half.");
  draw_text(w, side + " missed", contacts_text(run), run.missed > 0);
  const std::string why = second                                     ? beside.stopped()
                          : session.simulation.stability().blow_up() ? session.simulation.stability().blow_up()->what
                                                                     : "";
  draw_text(w, side + " inside", why.empty() ? inside_text(run) : "stopped: " + why, run.inside > 0 || !why.empty());
  draw_text(w, side + " cost", cost_text(run), false);
}

/// Draws the line between the halves, which can be dragged.
void draw_line(Widgets& w, const UiState& ui, const ScreenRect& scene) {
  const float width = scene.max.x - scene.min.x, grip = w.px(9);
  const float at = scene.min.x + std::clamp(ui.line, render::min_half, 1 - render::min_half) * width;
  ImGui::GetBackgroundDrawList()->AddLine({at, scene.min.y}, {at, scene.max.y}, to_imgui(glm::vec3(1.0f)), w.px(2));
  ImGui::SetNextWindowPos({at - grip / 2, scene.min.y});
  ImGui::SetNextWindowSize({grip, scene.max.y - scene.min.y});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::Begin("Line", nullptr, frameless_window | ImGuiWindowFlags_NoBackground);
  ImGui::InvisibleButton("Line", {grip, scene.max.y - scene.min.y});
  w.register_item("Line between the halves", "Drag: moves the line between the two halves.");
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (ImGui::IsItemActive() && ImGui::GetIO().MouseDelta.x != 0)
    w.ask([line = (ImGui::GetIO().MousePos.x - scene.min.x) / width](UiState& state) { state.line = line; });
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace

float beside_height(float scale) {
  return ImGui::GetFrameHeightWithSpacing() + lines * ImGui::GetTextLineHeightWithSpacing() + 12 * scale;
}

void draw_beside(Widgets& w, const Session& session, const UiState& ui, const ScreenRect& area,
                 const ScreenRect& scene) {
  if (!ui.beside_as_ghost) draw_line(w, ui, scene);
  begin_dock("Beside", area, true);
  w.keep_tooltips_off();
  const float top = ImGui::GetCursorPosY(), width = area.max.x - area.min.x;
  const float close = ImGui::GetFrameHeight(), ghost = w.px(76), gap = ImGui::GetStyle().ItemSpacing.x;
  // Each half's figures stand below it; those of a narrow one would not fit.
  const float line = std::clamp(ui.beside_as_ghost ? 0.5f : ui.line, 0.4f, 0.55f) * width;
  const auto column = [&](Half half, float begin, float end) {
    ImGui::SetCursorPos({begin, top});
    ImGui::PushClipRect({area.min.x + begin, area.min.y}, {area.min.x + end, area.max.y}, true);
    ImGui::BeginGroup();
    draw_half(w, session, half);
    ImGui::EndGroup();
    ImGui::PopClipRect();
  };
  column(Half::first, ImGui::GetStyle().WindowPadding.x, line - gap);
  column(Half::second, line + gap, width - ghost - close - 2 * gap);
  ImGui::SetCursorPos({width - close - ghost - gap, top});
  if (w.checkbox("Ghost", ui.beside_as_ghost, "Draws the second world translucent over the first, not beside it."))
    w.ask([](UiState& state) { state.beside_as_ghost = !state.beside_as_ghost; });
  ImGui::SetCursorPos({width - close - gap, top});
  if (w.button("x###Close beside", "Ends the second world (A).", close))
    w.ask([](Session& s) { s.simulation.toggle_beside(); });
  ImGui::End();
}

}  // namespace app::ui
