#include "app/ui/views/status.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include "app/render/palette.h"
#include "app/ui/views/coverage_light.h"

namespace app::ui {
namespace {

/// Returns "Auto (Semi-implicit Euler)" or "Runge-Kutta 4, 8 substeps".
std::string integrator_text(const softbody::World& world) {
  std::string text(world.integrator_choice().integrator().name);
  if (world.integrator_choice().integrator().automatic)
    text.append(" (").append(world.last_step().integrator->name).append(")");
  if (const auto substeps = world.integrator_choice().substeps)
    text.append(", ").append(std::to_string(*substeps)).append(*substeps == 1 ? " substep" : " substeps");
  return text;
}

constexpr double hint_seconds = 20, fade_seconds = 2;

std::string missed_text(const Session& session) {
  const session::LiveComparison& comparison = session.comparison;
  std::string text = "Contacts now: " + verdict(comparison, comparison.driver());
  const compare::CompareRow* row = comparison.driver_row();
  if (row && row->recall < 1) text += fmt::format(" (recall {:.4f})", rounded_down(row->recall));
  return text;
}

void draw_legend_line(Widgets& w, const render::LegendLine& line) {
  if (line.colour) w.swatch(*line.colour);
  line.pale ? ImGui::TextDisabled("%s", line.text.c_str()) : ImGui::TextUnformatted(line.text.c_str());
  if (line.colour) w.register_item("Legend");
  if (!line.scale) return;
  ImGui::SameLine();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = w.px(120), top = at.y + w.px(4), height = w.px(8);
  draw_colour_scale({at.x, top}, width, top + height, 30, line.scale);
  ImGui::Dummy({width, height});
  ImGui::SameLine();
  ImGui::TextDisabled("%s", line.end.c_str());
}

void draw_ghost_legend(Widgets& w, const Session& session) {
  ImGui::Text("Opaque: %s", integrator_text(*session.simulated()).c_str());
  w.register_item("Legend");
  draw_legend_line(w, {"Ghost: " + integrator_text(*session.ghost().world()), render::ghost_colour});
  ImGui::Text("RMS distance: %s", ghost_distance_text(session).c_str());
}

void draw_bucket_legend(Widgets& w, const Session& session) {
  ImGui::Text("Bucket %s", grouped(*session.inspector.selected_bucket()).c_str());
  draw_legend_line(w, {"entry of the chosen cell", render::same_cell_colour});
  draw_legend_line(w, {"entry of another cell (aliasing)", render::aliased_colour});
}

/// Draws text on the scene, centred, with a light background that keeps it legible on any colour. Its lower end is at
/// `y`. Returns its upper end.
float draw_scene_text(const Widgets& w, const char* text, float y, const ScreenRect& area, float alpha) {
  const ImVec2 pad{w.px(10), w.px(4)};
  const float room = area.max.x - area.min.x - 4 * pad.x;
  const ImVec2 size = ImGui::CalcTextSize(text, nullptr, false, room);
  const ImVec2 at{std::floor(0.5f * (area.min.x + area.max.x - size.x)), std::floor(y - size.y)};
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  draw->AddRectFilled({at.x - pad.x, at.y - pad.y}, {at.x + size.x + pad.x, at.y + size.y + pad.y},
                      to_imgui(glm::vec3(1.0f), 0.65f * alpha), w.px(6));
  draw->AddText(nullptr, 0, at, to_imgui(glm::vec3(0.15f), alpha), text, nullptr, room);
  return at.y - pad.y;
}

}  // namespace

StatusLight status_light(const collide::Method& method) {
  return status_light(method.exact ? collide::Coverage::exact : collide::Coverage::covered);
}

StatusLight status_light(collide::Coverage coverage) {
  static constexpr std::array<StatusLight, 3> lights{
      // by collide::Coverage
      {{render::status_green, "Green", "exact",
        "The method is exact: it finds every pair of vertices closer than the tolerance."},
       {render::status_amber, "Amber", "can miss",
        "The paper's method, and every box fits into a cell: it can miss contacts across cell faces. Or an exact "
        "method, but True surfaces found vertices inside other bodies."},
       {render::status_red, "Red", "can miss",
        "The paper's method, and a box is larger than a cell. It can miss contacts in the cells between its "
        "corners."}}};
  return lights.at(static_cast<std::size_t>(coverage));
}

std::string shown_method_text(const Session& session) {
  const collide::Method& shown = session.inspector.shown_method();
  const bool drives = shown.key == session.world().method().key;
  return shown.name + (drives ? ", driving" : ", for comparison");
}

std::string verdict(const session::LiveComparison& comparison, std::size_t method) {
  const compare::CompareReport& report = comparison.report();
  if (report.id != 0 && !report.reference) return "not measured";
  if (method < report.rows.size() && !report.rows[method].not_run.empty()) return "not run";
  const compare::CompareRow* row = comparison.scored_row(method);
  if (!row) return "being measured";
  if (report.true_contacts == 0) return "finds none, misses none";
  if (row->missed.empty()) return "finds all " + grouped(report.true_contacts);
  return fmt::format("misses {} of {}", grouped(row->missed.size()), grouped(report.true_contacts));
}

double rounded_down(double share) { return std::floor(share * 1e4) / 1e4; }

std::string reference_sentence(const compare::CompareReport& report) {
  if (!report.reference) return report.reference_note.empty() ? "Measuring" : "Not measured: " + report.reference_note;
  const std::string& name = collide::method_table()[*report.reference].name;
  std::string text = "Measured against " + name;
  return report.reference_note.empty() ? text : text + ": " + report.reference_note;
}

float draw_status(Widgets& w, const Session& session, bool explained, FloatingBox& box, const ScreenRect& area) {
  const float side = ImGui::GetFrameHeight();
  box.begin(w, "Status", area, box_width(w, area), false);
  const ImVec2 top = ImGui::GetCursorScreenPos();
  ImGui::SetCursorScreenPos({top.x + ImGui::GetContentRegionAvail().x - side, top.y});
  if (w.button("x###Close lights", "Puts the lights away (L). Drag the box to move it.", side))
    w.ask([](UiState& ui) { ui.lights = false; });
  ImGui::SetCursorScreenPos(top);
  ImGui::PushTextWrapPos(ImGui::GetContentRegionMax().x - side);
  draw_coverage_light(w, session, explained);
  w.text_line(missed_text(session));
  const std::string against = reference_sentence(session.comparison.report());
  w.register_item(
      "Live recall",
      "Contacts of a recent frame that the driving method missed. Recall is the share that it found. " + against + ".");
  if (session.simulated()) draw_step_light(w, session);
  ImGui::PopTextWrapPos();
  return box.end(area);
}

float draw_notices(Widgets& w, const Session& session, const std::string& no_room_message, const ScreenRect& area) {
  const session::Notice& notice = session.simulation.notice;
  if (notice.text().empty() && no_room_message.empty()) return area.min.y;
  const float margin = w.px(12);
  ImGui::SetNextWindowPos({area.min.x + margin, area.min.y + margin});
  ImGui::SetNextWindowSize({box_width(w, area), 0});
  ImGui::Begin("Notices", nullptr, frameless_window | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs);
  if (!no_room_message.empty()) w.wrapped_text("No room", no_room_message);
  if (!notice.text().empty()) w.wrapped_text("Notice", notice.text(), notice.is_error());
  const float end = ImGui::GetWindowPos().y + ImGui::GetWindowHeight();
  ImGui::End();
  return end;
}

std::string ghost_distance_text(const Session& session) {
  if (session.ghost().blown_up()) return "has blown up";
  return fmt::format("{:.3g} R", session.ghost().distances().latest());
}

bool has_legend(const Session& session, const render::Overlays& shown) {
  return session.ghost().world() || session.inspector.bucket() ||
         std::ranges::any_of(render::overlay_table,
                             [&](const render::OverlayRow& row) { return row.legend && shown.*row.shown; });
}

void draw_legend(Widgets& w, const Session& session, const render::Overlays& shown, bool names_method) {
  if (session.ghost().world()) draw_ghost_legend(w, session);
  const bool table = render::shows(shown, render::OverlayBasis::table);
  const render::LegendFacts facts{session.world(), table ? &session.inspector.shown_geometry() : nullptr,
                                  session.comparison.missed(),
                                  collide::method_table()[session.comparison.choice.misses_of].name};
  const auto draw_rows = [&](bool of_table) {
    for (const render::OverlayRow& row : render::overlay_table)
      if (row.legend && shown.*row.shown && (row.basis == render::OverlayBasis::table) == of_table)
        for (const render::LegendLine& line : row.legend(facts)) draw_legend_line(w, line);
  };
  draw_rows(true);
  if (names_method && (table || session.inspector.bucket()))
    ImGui::TextDisabled("%s", shown_method_text(session).c_str());
  if (session.inspector.bucket()) draw_bucket_legend(w, session);
  draw_rows(false);
}

void draw_floating_legend(Widgets& w, const Session& session, const render::Overlays& shown, const ScreenRect& area) {
  if (!has_legend(session, shown)) return;
  const float margin = w.px(12);
  ImGui::SetNextWindowPos({area.min.x + margin, area.min.y + w.px(8)});
  ImGui::Begin("Legend", nullptr, frameless_window | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs);
  // The window's width depends on the text, so the text must not wrap at the window's width.
  ImGui::PushTextWrapPos(area.max.x - area.min.x - 2 * margin - ImGui::GetStyle().WindowPadding.x);
  draw_legend(w, session, shown, true);
  ImGui::PopTextWrapPos();
  ImGui::End();
}

double seconds_to_hint_change(double seconds) {
  if (seconds > hint_seconds) return std::numeric_limits<double>::infinity();
  constexpr double fade_step = 1.0 / 30;
  return std::max(fade_step, hint_seconds - fade_seconds - seconds);
}

float draw_caption(Widgets& w, const Session& session, const ScreenRect& area, double seconds) {
  const float bottom = area.max.y - w.px(14), line = ImGui::GetTextLineHeight() + w.px(14);
  float hint = bottom - line;  // a line stays free for the caption, so that the hint does not move
  if (!session.simulation.caption().empty())
    hint = std::min(hint, draw_scene_text(w, session.simulation.caption().c_str(), bottom, area, 1.0f) - w.px(10));
  const float alpha = static_cast<float>(std::clamp((hint_seconds - seconds) / fade_seconds, 0.0, 1.0));
  if (alpha <= 0) return hint;
  const char* text = session.simulated()
                         ? "Drag a body to pull it. Drag the background to orbit. B throws a body. "
                           "G:\u00a0tour. F1:\u00a0help."
                         : "Drag to orbit. Click a body to select it. V:\u00a0compare the methods. G:\u00a0tour. "
                           "F1:\u00a0help.";
  return draw_scene_text(w, text, hint, area, alpha);
}

}  // namespace app::ui
