#include "app/ui/views/coverage_light.h"

#include <fmt/core.h>
#include <glm/common.hpp>

#include "softbody/world/measures.h"

namespace app::ui {
namespace {

std::string metres(const glm::vec3& size) { return fmt::format("{:.3f} x {:.3f} x {:.3f} m", size.x, size.y, size.z); }

/// Returns what the method finds on this frame, in one short line.
std::string promise(const softbody::BodiesInMotion& world) {
  switch (world.detection().coverage) {
    case collide::Coverage::exact:
      return fmt::format("Exact: finds all vertex pairs closer than {:.3g} m", world.collision().tolerance);
    case collide::Coverage::covered:
      return "Paper's method: can miss pairs across a cell face";
    default:
      return "Paper's method: can miss pairs, boxes exceed cells";
  }
}

/// Draws the meaning of a colour with its dot; `active`: not in grey.
void draw_meaning(Widgets& w, collide::Coverage coverage, bool active) {
  const StatusLight light = status_light(coverage);
  w.dot(light.colour);
  const std::string text = fmt::format("{}: {}", light.name, light.sentence);
  active ? w.paragraph(text) : w.pale_text(text);
}

}  // namespace

SurfaceRemark surface_remark(const Session& session) {
  if (session.surfaces.on) {
    const compare::SurfaceReport& report = session.surfaces.report();
    if (!report.failure.empty()) return {"Surfaces are not checked"};
    if (report.id == 0) return {"Checking surfaces"};
    const std::size_t inside = report.figures.penetrating_vertices;
    if (inside == 0) return {"No vertex is inside another body"};
    if (inside == 1) return {"But 1 vertex is inside another body", true};
    return {fmt::format("But {} vertices are inside other bodies", grouped(inside)), true};
  }
  const double safe = session.simulated() ? softbody::safe_vertex_tolerance(*session.simulated()) : 0;
  if (double{session.world().collision().tolerance} >= safe) return {};
  return {fmt::format("Tolerance below {:.2g} m: vertices can slip through faces", safe)};
}

std::string box_against_cell(const collide::DebugGeometry& paper, const glm::vec3& cell) {
  if (paper.boxes.empty()) return "The boxes of this frame are not known: pause to see them.";
  glm::vec3 largest(0.0f);
  for (const auto& [lo, hi, body] : paper.boxes) largest = glm::max(largest, hi - lo);
  std::string text = fmt::format("Largest box: {}\nCell: {}\n", metres(largest), metres(cell));
  std::string beyond;
  for (int axis = 0; axis < 3; ++axis) {
    if (largest[axis] <= cell[axis]) continue;
    beyond.append(beyond.empty() ? "" : ", ").append(1, "xyz"[axis]);
  }
  if (beyond.empty()) return text + "Every box fits into a cell.";
  return text.append("Along ").append(beyond).append(" a box is larger, so cells between its corners are skipped.");
}

void draw_coverage_light(Widgets& w, const Session& session, bool explained) {
  const SurfaceRemark remark = surface_remark(session);
  const collide::Coverage found = session.world().detection().coverage;
  // Vertices inside other bodies count as little as a method that can miss contacts.
  const collide::Coverage now =
      remark.penetrates && found == collide::Coverage::exact ? collide::Coverage::covered : found;
  ImGui::BeginGroup();
  w.dot(status_light(now).colour);
  ImGui::BeginGroup();
  w.paragraph(promise(session.world()));
  if (!remark.text.empty()) w.paragraph(remark.text);
  ImGui::EndGroup();
  ImGui::EndGroup();
  const bool clicked = ImGui::IsItemClicked();
  w.register_item("Coverage", explained ? "Click to hide the meaning of the colours."
                                        : "Click to see what the colours mean (§2.2).");
  if (clicked) w.ask([](UiState& ui) { ui.coverage_explained = !ui.coverage_explained; });
  if (!explained) return;
  ImGui::Separator();
  for (const collide::Coverage each :
       {collide::Coverage::exact, collide::Coverage::covered, collide::Coverage::exceeded})
    draw_meaning(w, each, each == now);
  w.wrapped_text("Coverage explained",
                 box_against_cell(session.inspector.paper_geometry(), *session.world().collision().cell_size));
  ImGui::Separator();
}

}  // namespace app::ui
