#include "app/ui/views/status.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <vector>

#include <fmt/core.h>

#include "app/render/palette.h"
#include "app/ui/views/coverage_light.h"

namespace app::ui {
namespace {

std::string missed_text(const Session& session) {
  const session::LiveComparison& comparison = session.comparison;
  std::string text = "Contacts now: " + verdict(comparison, comparison.driver());
  const compare::CompareRow* row = comparison.driver_row();
  if (row && row->recall < 1) text += fmt::format(" (recall {:.4f})", rounded_down(row->recall));
  return text;
}

/// Draws the lines of a legend one below another, or one behind another where they fit.
void draw_lines(Widgets& w, const std::vector<render::LegendLine>& lines, bool flow) {
  const float gap = w.px(18), scale_width = w.px(120);
  for (const render::LegendLine& line : lines) {
    const float width = ImGui::CalcTextSize(line.text.c_str()).x +
                        (line.colour ? 0.7f * ImGui::GetFontSize() + ImGui::GetStyle().ItemSpacing.x : 0) +
                        (line.scale ? scale_width + ImGui::CalcTextSize(line.end.c_str()).x + 2 * gap : 0);
    if (flow && &line != &lines.front()) {
      ImGui::SameLine(0, gap);
      if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
    }
    ImGui::BeginGroup();
    if (line.colour) w.swatch(*line.colour);
    const std::string text = wrapped(line.text, ImGui::GetContentRegionAvail().x);
    line.pale ? ImGui::TextDisabled("%s", text.c_str()) : ImGui::TextUnformatted(text.c_str());
    if (line.scale) {
      ImGui::SameLine();
      const ImVec2 at = ImGui::GetCursorScreenPos();
      draw_colour_scale({at.x, at.y + w.px(4)}, scale_width, at.y + w.px(12), 30, line.scale);
      ImGui::Dummy({scale_width, w.px(8)});
      ImGui::SameLine();
      ImGui::TextDisabled("%s", line.end.c_str());
    }
    ImGui::EndGroup();
    w.register_item("Legend");
  }
}

}  // namespace

StatusLight status_light(const collide::Method& method) {
  return status_light(method.exact         ? collide::Coverage::exact
                      : method.can_drive() ? collide::Coverage::covered
                                           : collide::Coverage::unknown);
}

StatusLight status_light(collide::Coverage coverage) {
  static constexpr std::array<StatusLight, 4> lights{
      // by collide::Coverage
      {{render::status_green, "Green", "exact",
        "The method is exact: it finds every pair of vertices closer than the tolerance."},
       {render::status_amber, "Amber", "can miss",
        "The paper's method, and every box fits into a cell: it can miss contacts across cell faces. Or an exact "
        "method, but True surfaces found vertices inside other bodies."},
       {render::status_red, "Red", "can miss",
        "The paper's method, and a box is larger than a cell. It can miss contacts in the cells between its "
        "corners."},
       {render::status_amber, "Amber", "can miss", "A method of your own: it can miss any contact."}}};
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

void draw_status(Widgets& w, const Session& session, bool explained) {
  draw_coverage_light(w, session, explained);
  w.text_line(missed_text(session));
  const std::string against = reference_sentence(session.comparison.report());
  w.register_item(
      "Live recall",
      "Contacts of a recent frame that the driving method missed. Recall is the share that it found. " + against + ".");
  if (session.simulated()) draw_step_light(w, session);
}

bool has_legend(const Session& session, const render::Overlays& shown) {
  return session.inspector.bucket() || std::ranges::any_of(render::overlay_table, [&](const render::OverlayRow& row) {
           return row.legend && shown.*row.shown;
         });
}

void draw_legend(Widgets& w, const Session& session, const render::Overlays& shown, bool names_method, bool flows) {
  std::vector<render::LegendLine> lines;
  const bool table = render::shows(shown, render::OverlayBasis::table);
  const render::LegendFacts facts{session.world(), table ? &session.inspector.shown_geometry() : nullptr,
                                  session.comparison.missed(),
                                  collide::method_table()[session.comparison.choice.misses_of].name};
  const auto add_rows = [&](bool of_table) {
    for (const render::OverlayRow& row : render::overlay_table)
      if (row.legend && shown.*row.shown && (row.basis == render::OverlayBasis::table) == of_table)
        std::ranges::move(row.legend(facts), std::back_inserter(lines));
  };
  add_rows(true);
  if (names_method && (table || session.inspector.bucket()))
    lines.push_back({.text = shown_method_text(session), .pale = true});
  if (session.inspector.bucket()) {
    lines.push_back({"Bucket " + grouped(*session.inspector.selected_bucket())});
    lines.push_back({"entry of the chosen cell", render::same_cell_colour});
    lines.push_back({"entry of another cell (aliasing)", render::aliased_colour});
  }
  add_rows(false);
  draw_lines(w, lines, flows);
}

}  // namespace app::ui
