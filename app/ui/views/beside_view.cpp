// Two worlds side by side: the strip below the scene with what each has cost and missed, and the line between them.

#include <algorithm>

#include <fmt/core.h>

#include "app/compare/difference.h"
#include "app/render/halves.h"
#include "app/ui/state/ui_state.h"
#include "app/ui/views/views.h"

namespace app::ui {
namespace {

using session::Half;

std::string contacts_text(const compare::RunTotals& run) {
  if (run.true_contacts == 0) return "no contacts yet";
  if (run.missed == 0) return fmt::format("missed none of {} contacts", grouped(run.true_contacts));
  return fmt::format("missed {} of {} contacts, {:.2g} %", grouped(run.missed), grouped(run.true_contacts),
                     100 * double(run.missed) / double(run.true_contacts));
}

std::string inside_text(const compare::RunTotals& run) {
  const auto vertices = [](std::size_t count, double depth) {
    return count == 0 ? "none" : fmt::format("{}, {:.2f} m deep", grouped(count), depth);
  };
  return fmt::format("vertices inside other bodies: {}; most seen: {}", vertices(run.inside, run.depth),
                     vertices(run.most_inside, run.deepest));
}

std::string cost_text(const compare::RunTotals& run) {
  return run.frames == 0 ? "detection: not timed yet"
                         : fmt::format("detection {:.3g} ms a frame", run.detect_ms / run.frames);
}

void draw_half(Widgets& w, const Session& session, Half half, const std::string& side) {
  const session::Beside& beside = *session.simulation.beside();
  const compare::RunTotals& run = beside.figures(half).totals();
  const softbody::World& world = *session.simulation.simulated(half);
  if (ImGui::RadioButton(("###" + side + " half").c_str(), session.simulation.edits == half))
    w.ask([half](Session& s) { s.simulation.edits = half; });
  w.register_item(side + " half", half == Half::first
                                      ? "The panel changes this half, and the right one where the two do not differ."
                                      : "The panel changes this half alone.");
  ImGui::SameLine();
  w.paragraph(side + ": " + beside.difference().text({world.scene(), world.integrator_choice()}));
  w.wrapped_text(side + " missed", contacts_text(run), run.missed > 0);
  const std::string why = stopped(session.simulation, half);
  w.wrapped_text(side + " inside", why.empty() ? inside_text(run) : "stopped: " + why, run.inside > 0 || !why.empty());
  w.wrapped_text(side + " cost", cost_text(run));
}

/// Draws the line between the halves, which can be dragged.
void draw_line(Widgets& w, const UiState& ui, const ScreenRect& scene) {
  const float width = scene.max.x - scene.min.x, grip = w.px(9);
  const float at = scene.min.x + std::clamp(ui.line, render::min_half, 1 - render::min_half) * width;
  ImGui::GetBackgroundDrawList()->AddLine({at, scene.min.y}, {at, scene.max.y}, to_imgui(glm::vec3(1.0f)), w.px(2));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  begin_dock("Line", {{at - grip / 2, scene.min.y}, {at + grip / 2, scene.max.y}}, false,
             ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoNav);
  ImGui::InvisibleButton("Line", {grip, scene.max.y - scene.min.y});
  w.register_item("Line between the halves", "Drag: moves the line between the two halves.");
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (ImGui::IsItemActive() && ImGui::GetIO().MouseDelta.x != 0)
    w.ask([line = (ImGui::GetIO().MousePos.x - scene.min.x) / width](UiState& state) { state.line = line; });
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace

float draw_beside(Widgets& w, const Session& session, const UiState& ui, const ScreenRect& area,
                  const ScreenRect& scene) {
  if (!ui.beside_as_ghost) draw_line(w, ui, scene);
  begin_dock("Beside", area, false, ImGuiWindowFlags_NoScrollbar);
  w.keep_tooltips_off();
  // Each half's figures stand below it; those of a narrow one need room nevertheless.
  const float line = ui.beside_as_ghost ? 0.5f : std::clamp(ui.line, 0.4f, 0.6f), buttons = w.px(100);
  if (ImGui::BeginTable("Halves", 3)) {
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, line);
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 1 - line);
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, buttons);
    ImGui::TableNextColumn();
    draw_half(w, session, Half::first, ui.beside_as_ghost ? "Solid" : "Left");
    ImGui::TableNextColumn();
    draw_half(w, session, Half::second, ui.beside_as_ghost ? "Ghost" : "Right");
    ImGui::TableNextColumn();
    if (w.button("Restart both", "Starts both worlds from the beginning of the scene (R).", buttons))
      w.ask([](Session& s) { s.simulation.reset(); });
    if (w.button("Close###Close beside", "Ends the second world (A).", buttons))
      w.ask([](Session& s) { toggle_beside(s.simulation); });
    if (w.checkbox("Ghost", ui.beside_as_ghost, "Draws the second world translucent over the first, not beside it."))
      w.ask([](UiState& state) { state.beside_as_ghost = !state.beside_as_ghost; });
    ImGui::EndTable();
  }
  const float height = ImGui::GetCursorPosY() + ImGui::GetStyle().WindowPadding.y;
  ImGui::End();
  return height;
}

}  // namespace app::ui
