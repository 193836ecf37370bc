#include "app/ui/views/coverage_light.h"

#include <fmt/core.h>
#include <glm/common.hpp>

namespace app::ui {
namespace {

std::string metres(const glm::vec3& size) { return fmt::format("{:.3f} x {:.3f} x {:.3f} m", size.x, size.y, size.z); }

/// Draws the meaning of a colour with its dot; `active`: not in grey.
void draw_meaning(Widgets& w, collide::Coverage coverage, bool active) {
  const StatusLight light = status_light(coverage);
  w.dot(light.colour);
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(active ? ImGuiCol_Text : ImGuiCol_TextDisabled));
  const bool exact = coverage == collide::Coverage::exact;
  ImGui::TextWrapped("%s: %s%s", light.name, exact ? "" : "the paper's method, and ", light.sentence);
  ImGui::PopStyleColor();
}

}  // namespace

std::string box_against_cell(const collide::DebugGeometry& paper, const glm::vec3& cell) {
  if (paper.boxes.empty()) return "No boxes are known for this picture: pause to see them.";
  glm::vec3 largest(0.0f);
  for (const auto& [lo, hi, body] : paper.boxes) largest = glm::max(largest, hi - lo);
  std::string text = fmt::format("Largest box in this frame: {}; cell: {}. ", metres(largest), metres(cell));
  std::string beyond;
  for (int axis = 0; axis < 3; ++axis) {
    if (largest[axis] <= cell[axis]) continue;
    beyond.append(beyond.empty() ? "" : ", ").append(1, "xyz"[axis]);
  }
  if (beyond.empty()) return text + "Every box fits: its corners reach every cell that it overlaps.";
  return text.append("Along ").append(beyond).append(" a box is larger: cells between its corners are skipped.");
}

void draw_coverage_light(Widgets& w, const Session& session, bool& explained) {
  const collide::Coverage now = session.world().detection().coverage;
  const StatusLight light = status_light(now);
  const std::string fit = box_against_cell(session.inspector.paper_geometry(), session.world().collision().cell_size);
  ImGui::BeginGroup();
  w.dot(light.colour);
  ImGui::TextWrapped("%s: %s", light.name, light.sentence);
  ImGui::EndGroup();
  const bool clicked = ImGui::IsItemClicked();
  w.register_item("Coverage", fmt::format("What the method and its settings promise on this frame (§2.2). {}{}", fit,
                                          explained ? " Click: less." : " Click: what the colours mean.")
                                  .c_str());
  if (clicked) explained = !explained;
  if (!explained) return;
  ImGui::Separator();
  for (const collide::Coverage each :
       {collide::Coverage::exact, collide::Coverage::covered, collide::Coverage::exceeded})
    draw_meaning(w, each, each == now);
  ImGui::TextWrapped("%s", fit.c_str());
  w.register_item("Coverage explained", nullptr);
  ImGui::Separator();
}

}  // namespace app::ui
