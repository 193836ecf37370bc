#include "app/ui/views/sweep_view.h"

#include <algorithm>

#include <fmt/core.h>

#include "app/base/text.h"
#include "app/ui/views/views.h"
#include "app/ui/widgets/method_mark.h"

namespace app::ui {
namespace {

constexpr std::size_t max_reasons = 8;

bool was_run(const compare::SweepRow& row) { return row.not_run.empty(); }

/// Returns "Multi-Level SB, level 3, 1,001 buckets, cells x 0.5", with only the settings that the method uses.
std::string configuration_text(const compare::Configuration& c) {
  const collide::Method& method = collide::method_table()[c.method];
  std::string text = method.name;
  if (method.uses_levels) text += fmt::format(", level {}", c.settings.levels);
  if (method.uses_hash) text += fmt::format(", {} buckets, cells x {:g}", grouped(c.settings.buckets), c.cell);
  return text;
}

std::string point_tooltip(const compare::SweepRow& row) {
  const glm::vec3& cell = *row.configuration.settings.cell_size;
  const collide::Method& method = collide::method_table()[row.configuration.method];
  return fmt::format(
      "{}{}\n{:.4g} ms: median of {}, smallest {:.4g}\nRecall {:.4f}, precision {:.4f}; {} contact{} missed\n"
      "{}About {} KiB of memory\n{}\nClick to use these settings.",
      configuration_text(row.configuration),
      method.uses_hash ? fmt::format("\nCells of {:.3g} x {:.3g} x {:.3g} m", cell.x, cell.y, cell.z) : "",
      row.times.median(), row.times.ms.size(), row.times.min(), rounded_down(row.recall), rounded_down(row.precision),
      grouped(row.missed), row.missed == 1 ? "" : "s",
      method.can_drive()
          ? fmt::format("{} pair tests, {} hashes\n", grouped(row.counters.pair_tests), grouped(row.counters.hashes))
          : "",
      grouped(row.memory / 1024), status_light(row.coverage).sentence);
}

/// Lists what was not run and why, at most max_reasons of them.
std::string not_run_text(const compare::SweepReport& report) {
  std::vector<std::string> reasons;
  std::size_t all = 0;
  for (const compare::SweepRow& row : report.rows)
    if (!was_run(row) && ++all <= max_reasons)
      reasons.push_back(configuration_text(row.configuration) + ": " + row.not_run);
  if (all == 0) return "All settings fit the budget.";
  const std::string text = joined(reasons, "\n");
  return all > max_reasons ? text + fmt::format("\nand {} more.", grouped(all - max_reasons)) : text;
}

bool in_use(const compare::SweepRow& row, const softbody::BodiesInMotion& world) {
  const collide::Method& method = collide::method_table()[row.configuration.method];
  const collide::Settings &its = row.configuration.settings, &now = world.collision();
  if (method.key != world.method().key || (method.uses_levels && its.levels != now.levels)) return false;
  return !method.uses_hash || (its.buckets == now.buckets && its.cell_size == now.cell_size);
}

/// Applies the settings that a sweep varies; the others keep their present values.
void apply(const compare::Configuration& c, Session& session) {
  session.simulation.change_scene("Settings of the sweep", [&](softbody::Scene& scene) {
    const collide::Method& method = collide::method_table()[c.method];
    scene.method = method.key;
    if (method.uses_levels) scene.collision.levels = c.settings.levels;
    if (!method.uses_hash) return;
    scene.collision.buckets = c.settings.buckets;
    scene.collision.cell_size = c.cell == 1 ? std::nullopt : c.settings.cell_size;
  });
}

std::string count_text(const session::SweepState& state) {
  const auto& rows = state.report.rows;
  if (rows.empty()) return {};
  const auto all = static_cast<std::size_t>(std::ranges::count_if(rows, was_run));
  const auto checked = static_cast<std::size_t>(std::ranges::count(rows, true, &compare::SweepRow::checked));
  const auto timed = static_cast<std::size_t>(
      std::ranges::count_if(rows, [](const compare::SweepRow& row) { return !row.times.ms.empty(); }));
  std::string text = fmt::format("{} of {}", grouped(checked < all ? checked : timed), grouped(all));
  text += checked < all ? " checked" : state.progress < 1 ? " timed once" : " timed";
  if (all < rows.size()) text += fmt::format(", {} not run", grouped(rows.size() - all));
  return text;
}

std::string footer(const session::SweepState& state) {
  if (state.scene.empty()) return "No sweep yet.";
  std::string text = fmt::format("{}, frame {}. ", state.scene, state.frame);
  const compare::SweepReport& report = state.report;
  if (report.reference) {
    text += fmt::format("{} true contacts by {}{}", grouped(report.true_contacts),
                        collide::method_table()[report.reference->method].name,
                        report.reference_note.empty() ? "." : " in place of brute force.");
  } else if (!report.reference_note.empty()) {
    text += fmt::format("No true contacts: {}.", report.reference_note);
  }
  return text;
}

/// Draws a sample and its meaning, `gap` design pixels beside the previous entry, or on a new line if there is no room.
template <class Draw>
void draw_legend_entry(Widgets& w, const std::string& text, const char* tip, float gap, const Draw& draw_sample) {
  const float line = ImGui::GetTextLineHeight(), inner = w.px(5);
  const float width = line + inner + ImGui::CalcTextSize(text.c_str()).x;
  const float end = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
  if (ImGui::GetItemRectMax().x + w.px(gap) + width <= end) ImGui::SameLine(0, w.px(gap));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::Dummy({width, line});
  w.register_item(fmt::format("Legend {}", text), tip);
  draw_sample(ImVec2(at.x + 0.5f * line, at.y + 0.5f * line));
  ImGui::GetWindowDrawList()->AddText({at.x + line + inner, at.y}, ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
}

void draw_progress(Widgets& w, const session::SweepState& state, float width) {
  const std::string text =
      state.stop_reason.empty() ? fmt::format("{:.0f} %", 100 * state.progress) : state.stop_reason;
  ImVec4 colour = ImGui::GetStyleColorVec4(ImGuiCol_PlotHistogram);
  colour.w = 0.35f;  // faint, as it is the text's background
  ImGui::PushStyleColor(ImGuiCol_PlotHistogram, colour);
  ImGui::ProgressBar(static_cast<float>(state.progress), {width, 0}, text.c_str());
  ImGui::PopStyleColor();
  w.register_item("Sweep progress",
                  state.stop_reason.empty()
                      ? "Checks the contacts of each setting first, then times all settings up to five times."
                      : state.stop_reason);
}

void draw_button(Widgets& w, const Session& session) {
  constexpr const char* sweep_tooltip =
      "Runs each shown method with all its levels, four bucket counts and five cell sizes on a copy of this frame. "
      "Pause (Space) for the steadiest times.";
  const float width = w.px(130);
  if (!session.sweep().running) {
    if (w.button("Sweep this frame###Sweep", sweep_tooltip, width))
      w.ask([](Session& s) { s.sweep_worker.start(s.world(), s.comparison.shown_methods()); });
    return;
  }
  const bool cancelling = session.sweep_worker.cancelling();
  if (w.button(cancelling ? "Cancelling###Sweep" : "Cancel###Sweep", "Ends the sweep and keeps its results so far.",
               width, !cancelling))
    w.ask([](Session& s) { s.sweep_worker.cancel(); });
}

void draw_controls(Widgets& w, const Session& session) {
  draw_button(w, session);
  ImGui::SameLine();
  ImGui::SetNextItemWidth(w.px(150));
  draw_shown_methods(w, session);
  ImGui::SameLine();
  draw_progress(w, session.sweep(), ImGui::GetContentRegionAvail().x - w.px(190));
  ImGui::SameLine();
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() + ImGui::GetStyle().FramePadding.y);
  w.text_line(count_text(session.sweep()));
  w.register_item("Sweep counts", not_run_text(session.sweep().report));
}

/// Draws the legend of these methods. Returns the one under the mouse.
std::optional<std::size_t> draw_legend(Widgets& w, const compare::MethodSet& shown) {
  constexpr float gap = 12, group_gap = 28, new_line = 1e4f;
  std::optional<std::size_t> hovered;
  std::optional<collide::MethodGroup> group;  // of the entry before
  bool levels = false;
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ImGui::GetStyle().ItemSpacing.x, w.px(3)});
  for (std::size_t m = 0; m < shown.size(); ++m) {
    if (!shown[m]) continue;
    const collide::Method& method = collide::method_table()[m];
    const compare::MethodStyle style = compare::style(method);
    draw_legend_entry(w, method.name, "Highlights the points of this method.",
                      !group                  ? new_line
                      : group == method.group ? gap
                                              : group_gap,
                      [&](ImVec2 at) { draw_marker(at, w.px(5), style.marker, to_imgui(style.colour), w.px(1.8f)); });
    if (ImGui::IsItemHovered()) hovered = m;
    group = method.group;
    levels |= method.uses_levels;
  }
  for (std::size_t level = 0; levels && level < compare::sweep_levels.size(); ++level) {
    draw_legend_entry(w, fmt::format("level {}", compare::sweep_levels[level]),
                      "Points of this subdivision level (§2.1).", level == 0 ? new_line : gap, [&](ImVec2 at) {
                        draw_marker(at, w.px(SweepPlot::mark_radius(level)), compare::Marker::disc,
                                    ImGui::GetColorU32(ImGuiCol_TextDisabled), w.px(1));
                      });
  }
  draw_legend_entry(w, "Pareto front", "No other point is both faster and better.", levels ? group_gap : new_line,
                    [&](ImVec2 at) {
                      const float half = w.px(7);
                      ImGui::GetWindowDrawList()->AddLine({at.x - half, at.y}, {at.x + half, at.y},
                                                          ImGui::GetColorU32(ImGuiCol_Text), w.px(1.5f));
                    });
  draw_legend_entry(w, "in use", "The method and settings that drive the bodies now.", gap,
                    [&](ImVec2 at) { SweepPlot::draw_ring(w, at); });
  ImGui::PopStyleVar();
  return hovered;
}

}  // namespace

float SweepView::preferred_height(std::size_t methods, float window) {
  const float lanes = 9 * static_cast<float>(methods);  // and lines of the legend
  return std::clamp(0.44f * window + lanes, min_height, 370 + lanes);
}

void SweepView::draw_plot(Widgets& w, const Session& session, float height, std::optional<std::size_t> method) {
  const ImVec2 min = ImGui::GetCursorScreenPos();
  const ImVec2 size{ImGui::GetContentRegionAvail().x, height};
  const bool clicked = ImGui::InvisibleButton("##scatter", size);
  const bool hovered = ImGui::IsItemHovered();
  w.register_item("Scatter");
  SweepPlot::Emphasis emphasis{.method = method, .row = {}};
  for (const SweepPlot::Point& point : plot_.points())
    if (in_use(session.sweep().report.rows[point.row], session.world())) emphasis.row = point.row;
  plot_.draw(w, {min, {min.x + size.x, min.y + size.y}}, emphasis);
  const SweepPlot::Point* under = hovered ? plot_.hit_test(w, ImGui::GetIO().MousePos) : nullptr;
  if (!under) return;
  const compare::SweepRow& row = session.sweep().report.rows[under->row];
  w.show_tooltip(point_tooltip(row));
  if (clicked) w.ask([c = row.configuration](Session& s) { apply(c, s); });
}

void SweepView::draw(Widgets& w, const Session& session, const ScreenRect& area) {
  // Opaque: the scene's colours would make the points hard to tell apart.
  begin_dock("Error against run time###Sweep view", area, true, ImGuiWindowFlags_NoScrollbar);
  w.keep_tooltips_off();
  if (w.button("x###Close sweep", "Closes the plot (E). A sweep continues.", ImGui::GetFrameHeight()))
    w.ask([](UiState& ui) { ui.lower = LowerView::none; });
  ImGui::SameLine();
  draw_controls(w, session);
  const compare::MethodSet shown = session.comparison.shown_methods();
  plot_.set(session.sweep().report, shown);
  const std::optional<std::size_t> hovered = draw_legend(w, shown);
  const float footing = ImGui::GetTextLineHeight() + ImGui::GetStyle().ItemSpacing.y;
  draw_plot(w, session, ImGui::GetContentRegionAvail().y - footing, hovered);
  w.text_line(footer(session.sweep()));
  const std::string& why = session.sweep().report.reference_note;
  w.register_item("Sweep footing", why.empty() ? "The frame of the sweep." : why);
  ImGui::End();
}

}  // namespace app::ui
