#include "app/ui/status.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "app/render/palette.h"
#include "app/ui/panel/integrators.h"
#include "app/ui/panel/light.h"

namespace app {
namespace {

constexpr double hint_seconds = 20, fade_seconds = 2;

std::string recall_sentence(const Session& session) {
  const CompareReport& report = session.comparison();
  if (report.id != 0 && !report.reference) return "Recall not measured: " + report.stands_in;
  const CompareRow* row = session.driver_row();
  if (!row) return "Recall: measuring";
  std::string text = fmt::format("Recall {:.4f}   ", rounded_down(row->recall));
  text += report.true_contacts == 0 ? "no contacts in the frame last measured"
                                    : fmt::format("{} of {} contacts missed when last measured",
                                                  grouped(row->missed.size()), grouped(report.true_contacts));
  if (!report.stands_in.empty()) text += " (see Compare: V)";
  return text;
}

}  // namespace

Light light_of(collide::Coverage coverage) {
  switch (coverage) {
    case collide::Coverage::exact:
      return {light_green, "Green", "this method is exact and misses no contact."};
    case collide::Coverage::covered:
      return {light_amber, "Amber", "every box fits a cell; only contacts across cell faces can be missed."};
    default:
      return {light_red, "Red", "a box is larger than a cell, so its corners skip cells."};
  }
}

std::string whose_structure(const Session& session) {
  const collide::Method& shown = session.shown_method();
  if (shown.key == session.world().method().key) return "of the driving method";
  return "of " + std::string(shown.name) + ", for comparison";
}

double rounded_down(double share) { return std::floor(share * 1e4) / 1e4; }

std::string reference_sentence(const CompareReport& report) {
  if (!report.reference) return report.stands_in.empty() ? "Measuring" : "Not measured: " + report.stands_in;
  const std::string name(collide::method_table()[*report.reference].name);
  std::string text = "Measured against " + name;
  return report.stands_in.empty() ? text : text + ": " + report.stands_in;
}

float draw_status(Widgets& w, Session& session, const std::string& no_room, const SceneArea& area, bool& explained) {
  const float margin = w.px(12);
  const float width = std::min(w.px(520), area.max.x - area.min.x - 2 * margin);
  ImGui::SetNextWindowPos({area.min.x + margin, area.min.y + margin});
  ImGui::SetNextWindowSize({width, 0});
  ImGui::Begin("Status", nullptr, plate | ImGuiWindowFlags_AlwaysAutoResize);
  draw_light(w, session, explained);
  w.line(recall_sentence(session));
  const std::string against = reference_sentence(session.comparison());
  w.done("Live recall",
         ("Found true contacts over all true contacts, of the driving method on a frame of a moment ago, "
          "counted beside the simulation. " +
          against)
             .c_str());
  draw_step_light(w, session);
  if (!no_room.empty()) {
    ImGui::TextWrapped("%s", no_room.c_str());
    w.done("No room", nullptr);
  }
  if (!session.notice().empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.75f, 0.1f, 0.1f, 1));
    ImGui::TextWrapped("%s", session.notice().c_str());
    ImGui::PopStyleColor();
    w.done("Notice", nullptr);
  }
  const float end = ImGui::GetWindowPos().y + ImGui::GetWindowHeight();
  ImGui::End();
  return end;
}

namespace {

void legend_line(Widgets& w, const glm::vec3& colour, const std::string& text) {
  w.chip(colour, ImGui::GetTextLineHeight());
  ImGui::SameLine();
  ImGui::TextUnformatted(text.c_str());
  w.done("Legend", nullptr);
}

void strain_scale(const Widgets& w) {
  ImGui::TextDisabled("-20 %%");
  ImGui::SameLine();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = w.px(120), top = at.y + w.px(4), height = w.px(8);
  constexpr int steps = 30;
  for (int i = 0; i < steps; ++i) {
    const float x0 = at.x + width * static_cast<float>(i) / steps,
                x1 = at.x + width * static_cast<float>(i + 1) / steps;
    const float t = 2 * (static_cast<float>(i) + 0.5f) / steps - 1;
    ImGui::GetWindowDrawList()->AddRectFilled({x0, top}, {x1, top + height}, to_imgui(diverging_colour(t)));
  }
  ImGui::Dummy({width, height});
  ImGui::SameLine();
  ImGui::TextDisabled("+20 %%");
}

void touches_legend(Widgets& w, const Session& session) {
  if (session.world().scene().contact_surface != softbody::ContactSurface::surfaces) {
    ImGui::TextDisabled("no surface contacts: F switches them on");
    return;
  }
  legend_line(w, contact_between_colour, "surface contact between bodies, and its normal");
  legend_line(w, contact_inside_colour, "surface contact inside one body");
}

void table_legend(Widgets& w, const Session& session, const Overlays& shown, bool of_which_method) {
  const collide::DebugGeometry& debug = session.debug();
  if (shown.boxes) {
    ImGui::TextUnformatted(debug.boxes.empty() ? "This method builds no boxes" : "Boxes: one colour, one bucket");
  }
  if (shown.cells) legend_line(w, cell_colour, "occupied cell");
  if (of_which_method) ImGui::TextDisabled("%s", whose_structure(session).c_str());
}

void bucket_legend(Widgets& w, const Session& session) {
  ImGui::Text("Bucket %s", grouped(*session.selected_bucket()).c_str());
  legend_line(w, same_cell_colour, "of the chosen cell");
  legend_line(w, aliased_colour, "of another cell: aliasing");
}

}  // namespace

bool has_legend(const Session& session, const Overlays& shown) {
  return shown.boxes || shown.cells || session.bucket() || session.ghost() || shown.contacts || shown.springs ||
         shown.missed || shown.areas || shown.touches;
}

void draw_legend(Widgets& w, const Session& session, const Overlays& shown, bool of_which_method) {
  if (session.ghost()) draw_ghost_legend(w, session);
  if (shown.boxes || shown.cells || session.bucket()) table_legend(w, session, shown, of_which_method);
  if (session.bucket()) bucket_legend(w, session);
  if (shown.contacts) {
    legend_line(w, contact_between_colour, "contact between bodies");
    legend_line(w, contact_inside_colour, "contact inside one body");
    legend_line(w, contact_solid_colour, "contact with a solid");
  }
  if (shown.touches) touches_legend(w, session);
  if (shown.missed)
    legend_line(w, contact_missed_colour,
                std::string(session.missed() && session.missed()->empty() ? "none missed by " : "missed by ") +
                    std::string(collide::method_table()[session.misses_of()].name));
  if (shown.areas) legend_line(w, area_colour, "area that the exact method searches");
  if (shown.springs) {
    ImGui::TextUnformatted("Springs: shorter, longer than at rest");
    strain_scale(w);
  }
}

void draw_legend_plate(Widgets& w, const Session& session, const Overlays& shown, const SceneArea& area) {
  if (!has_legend(session, shown)) return;
  const float margin = w.px(12);
  ImGui::SetNextWindowPos({area.min.x + margin, area.min.y + w.px(8)});
  ImGui::Begin("Legend", nullptr, plate | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs);
  // The window takes its width from the text, so the text cannot take it from the window.
  ImGui::PushTextWrapPos(area.max.x - area.min.x - 2 * margin - ImGui::GetStyle().WindowPadding.x);
  draw_legend(w, session, shown, true);
  ImGui::PopTextWrapPos();
  ImGui::End();
}

namespace {

/// Text on the scene itself, centred, with a light edge that keeps it legible on any colour; its last line ends at `y`.
/// Returns its upper end.
float text_on_scene(const Widgets& w, const char* text, float y, const SceneArea& area, float alpha) {
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

float draw_caption(Widgets& w, const Session& session, const SceneArea& area, double seconds) {
  const float bottom = area.max.y - w.px(14), line = ImGui::GetTextLineHeight() + w.px(14);
  float hint = bottom - line;  // the caption's place stays free: the hint does not jump
  if (!session.caption().empty())
    hint = std::min(hint, text_on_scene(w, session.caption().c_str(), bottom, area, 1.0f) - w.px(10));
  const float left = static_cast<float>(std::clamp((hint_seconds - seconds) / fade_seconds, 0.0, 1.0));
  if (left <= 0) return hint;
  return text_on_scene(
      w, "Drag a body to pull it, drag beside it to turn, B throws a body, G explains the method, F1 for help", hint,
      area, left);
}

}  // namespace app
