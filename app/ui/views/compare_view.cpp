#include "app/ui/views/views.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "app/render/palette.h"
#include "app/ui/widgets/method_mark.h"

namespace app::ui {
namespace {

constexpr std::size_t median_count = session::LiveComparison::times_per_state;  // measurements of a median

enum ColumnIndex { name, time, recall, so_far, contacts, tests, hashes, precision, plot, misses, column_count };

struct Column {
  const char* label;
  float width;  // design pixels; 0: the rest
  bool right_aligned;
  const char* tooltip;
};

constexpr std::array<Column, column_count> columns{{
    {"Method", 220, false, ""},
    {"Time", 106, true,
     "Time to find all contacts from scratch on one core: median of the last 15 measurements (§3). While the frame "
     "stays the same, caches are warm. The panel's Detect is one search as the program runs."},
    {"Recall", 90, true,
     "Share of the true contacts that the method found. 1: none missed. Click a smaller one to see the first miss. The "
     "dot is the method's status light."},
    {"Since start", 90, true,
     "Recall over all frames that were compared since the scene started or the settings changed: the sum of the "
     "contacts found over that of the true ones."},
    {"Contacts", 72, true, "Number of pairs of vertices found closer than the tolerance (§2.3, §2.4)."},
    {"Pair tests", 96, true, "Number of distances between vertices that were evaluated (§2.3)."},
    {"Hashes", 80, true, "Number of evaluations of the hash function (§2.2)."},
    {"Precision", 78, true,
     "Share of the found contacts that are true. 1: no false contact (§2.3). Click a smaller one to see the first."},
    {"Latest times", 0, false, "The last measurements of the time. All methods have the same axis."},
    {"Misses", 56, true, "Choose the method whose missed contacts the scene shows (key 6)."},
}};
// All in design pixels.
constexpr float min_plot_width = 70, column_gap = 10;
constexpr float window_padding = 7, frame_padding = 1, row_gap = 1;  // above and below

/// Returns false for the precision while that of all methods is 1.
bool is_shown(std::size_t column, const Session& session) {
  const auto finds_false_ones = [](const compare::CompareRow& row) { return row.scored && row.precision < 1; };
  return column != precision || std::ranges::any_of(session.comparison.report().rows, finds_false_ones);
}

/// Returns the smallest width that all columns need, in design pixels.
float min_content_width() {
  float width = min_plot_width;
  for (const Column& column : columns) width += column.width;
  return width - columns[precision].width;
}

/// The ends of the columns, in screen coordinates, and the row that is being drawn.
struct Grid {
  std::array<float, column_count> left{}, right{};
  float top = 0, height = ImGui::GetFrameHeight();

  Grid(const Widgets& w, const Session& session, float start, float width) {
    float rest = width;
    for (std::size_t i = 0; i < column_count; ++i) rest -= is_shown(i, session) ? w.px(columns[i].width) : 0;
    for (std::size_t i = 0; i < column_count; ++i) {
      left[i] = start;
      if (is_shown(i, session)) start += columns[i].width > 0 ? w.px(columns[i].width) : rest;
      right[i] = start - w.px(column_gap);
    }
  }
  void next_row() { top = ImGui::GetCursorScreenPos().y; }
  float text_top() const { return top + 0.5f * (height - ImGui::GetTextLineHeight()); }

  /// Draws text that is no ImGui item, so that its length moves nothing.
  void text(ColumnIndex i, const std::string& text, bool pale = false) const {
    const float end = right[i] - (columns[i].right_aligned ? ImGui::CalcTextSize(text.c_str()).x : right[i] - left[i]);
    ImGui::GetWindowDrawList()->AddText({std::floor(end), text_top()},
                                        ImGui::GetColorU32(pale ? ImGuiCol_TextDisabled : ImGuiCol_Text), text.c_str());
  }
  /// Adds an invisible item over the column's cell, for a tooltip. Returns true if it was clicked.
  bool cell(Widgets& w, ColumnIndex i, const std::string& label, std::string_view tooltip) const {
    ImGui::SetCursorScreenPos({left[i], top});
    const bool clicked = ImGui::InvisibleButton(label.c_str(), {right[i] - left[i], height});
    return w.register_item(clicked, label, tooltip);
  }
};

/// What all rows have in common.
struct Scale {
  float max_median = 0;  // ms
  float axis_end = 1;    // ms, of the sparklines
};

Scale common_scale(const Session& session) {
  Scale scale;
  float largest = 0;
  for (const TimeSeries& times : session.comparison.method_ms()) {
    scale.max_median = std::max(scale.max_median, times.median(median_count));
    largest = std::max(largest, times.max());
  }
  scale.axis_end = axis_end(largest, 0.1f);
  return scale;
}

struct Row {
  std::size_t index;
  const collide::Method& method;
  const compare::CompareRow* measured;  // nullptr before the first report
  bool begins_group;                    // of the methods
  bool drives, is_reference;

  std::string label(const char* what) const { return std::string("###") + what + " " + method.name; }
  bool scored() const { return measured && measured->scored; }
};

void draw_misses_switch(Widgets& w, const Session& session, const UiState& ui, const Grid& grid, const Row& row) {
  ImGui::SetCursorScreenPos({grid.right[misses] - grid.height, grid.top});
  const bool shown = ui.overlays.missed && session.comparison.choice.misses_of == row.index;
  const std::string label = row.label("Misses of");
  if (w.register_item(ImGui::RadioButton(label.c_str(), shown), label,
                      "Shows the contacts that this method misses in the scene."))
    w.ask([method = row.index](Session& s, UiState& state) {
      s.comparison.choice.misses_of = method;
      state.overlays.missed = true;
    });
}

void draw_name(Widgets& w, const Grid& grid, const Row& row) {
  ImGui::SetCursorScreenPos({grid.left[name], grid.top});
  draw_method_mark(w, row.method, grid.height);
  const float left = ImGui::GetItemRectMax().x + w.px(6);
  ImGui::SetCursorScreenPos({left, grid.text_top()});
  const std::string text = row.method.name + row.label("Drive"),
                    tooltip = row.method.summary + (row.method.can_drive() ? " Click to let it drive the bodies." : "");
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(row.scored() ? ImGuiCol_Text : ImGuiCol_TextDisabled));
  const bool clicked = ImGui::Selectable(text.c_str(), false, 0, {grid.right[name] - left, 0});
  ImGui::PopStyleColor();
  if (w.register_item(clicked, text, tooltip) && row.method.can_drive())
    w.ask([&key = row.method.key](Session& s) { s.settings.set_method(key); });
}

void draw_time(const Widgets& w, const Session& session, const Grid& grid, const Row& row, const Scale& scale) {
  const TimeSeries& times = session.comparison.method_ms()[row.index];
  if (times.size() == 0) {
    if (row.is_reference && row.scored())
      grid.text(time, fmt::format("{:.2f} ms", session.comparison.report().reference_ms), true);
    else if (row.scored())
      grid.text(time, "not timed", true);
    return;
  }
  const float median = times.median(median_count);
  const float length = (grid.right[time] - grid.left[time]) * (scale.max_median > 0 ? median / scale.max_median : 0.0f);
  const float inset = w.px(2);
  ImGui::GetWindowDrawList()->AddRectFilled({grid.left[time], grid.top + inset},
                                            {grid.left[time] + length, grid.top + grid.height - inset},
                                            to_imgui(compare::style(row.method).colour, 0.45f), w.px(2));
  grid.text(time, fmt::format("{:.2f} ms", median));
}

/// Draws a recall or a precision, in red if it is below 1.
void draw_share(const Grid& grid, ColumnIndex column, double share) {
  if (share < 1) ImGui::PushStyleColor(ImGuiCol_Text, to_imgui(render::status_red));
  grid.text(column, fmt::format("{:.4f}", rounded_down(share)));
  if (share < 1) ImGui::PopStyleColor();
}

/// Returns what a tooltip says about the first pair of those that are wrong, whose vertices are so far apart (m).
std::string first_pair_text(const collide::Contact& pair, float distance) {
  return fmt::format(" The first: vertices {} and {}, {:.4g} m apart. Click to see it in the scene.", grouped(pair.a),
                     grouped(pair.b), distance);
}

/// Stops the world, shows what the method of the row misses, and lets the window look at a pair.
void ask_for_pair(Widgets& w, const Row& row, WindowTask pair) {
  w.ask([method = row.index, pair](Session& s, UiState& ui) {
    s.simulation.clock.paused = true;
    s.comparison.choice.misses_of = method;
    ui.overlays.missed = true;
    ui.once_compared = pair;
  });
}

void draw_score(Widgets& w, const Session& session, const Grid& grid, const Row& row) {
  const compare::CompareRow& found = *row.measured;
  const bool counts = row.method.can_drive();
  grid.text(tests, counts ? grouped(found.counters.pair_tests) : "-", !counts);
  grid.text(hashes, counts ? grouped(found.counters.hashes) : "-", found.counters.hashes == 0);
  grid.text(contacts, grouped(found.contacts));
  const StatusLight light = status_light(found.coverage);
  ImGui::SetCursorScreenPos({grid.left[recall] + w.px(4), grid.text_top()});
  w.dot(light.colour);
  const compare::RunTotals& sum = session.comparison.sum(row.index);
  if (row.is_reference) {
    grid.text(recall, "reference", true);
  } else {
    draw_share(grid, recall, found.recall);
    draw_share(grid, so_far, sum.recall());
    if (is_shown(precision, session)) draw_share(grid, precision, found.precision);
  }
  std::string tip = std::string(light.sentence) + " Missed: " + grouped(found.missed.size()) + ".";
  if (!found.missed.empty()) tip += first_pair_text(found.missed.front(), found.missed_distance);
  if (grid.cell(w, recall, row.label("Recall of"), tip) && !found.missed.empty())
    ask_for_pair(w, row, WindowTask::show_first_missed);
  if (found.first_false && grid.cell(w, precision, row.label("Precision of"),
                                     "Some are false." + first_pair_text(*found.first_false, found.false_distance)))
    ask_for_pair(w, row, WindowTask::show_first_false);
  grid.cell(w, so_far, row.label("Recall since start of"),
            fmt::format("Missed: {} of {} true contacts in {} frames.", grouped(sum.missed), grouped(sum.true_contacts),
                        grouped(std::uint64_t(sum.frames))));
}

/// Draws why the row has no score, beside its time if there is one.
void draw_reason(const Session& session, const Grid& grid, const Row& row) {
  std::string reason = "measuring";
  if (row.measured && !row.measured->not_run.empty()) reason = row.measured->not_run;
  const bool timed = session.comparison.method_ms()[row.index].size() > 0;
  ImGui::GetWindowDrawList()->AddText({grid.left[timed ? recall : time], grid.text_top()},
                                      ImGui::GetColorU32(ImGuiCol_TextDisabled), reason.c_str());
}

void draw_row(Widgets& w, const Session& session, const UiState& ui, Grid& grid, const Row& row, const Scale& scale) {
  grid.next_row();
  if (row.begins_group) {
    const float y = grid.top - w.px(0.5f * row_gap);
    ImGui::GetWindowDrawList()->AddLine({grid.left[name], y}, {grid.right[misses], y},
                                        ImGui::GetColorU32(ImGuiCol_Border));
  }
  if (row.drives)
    ImGui::GetWindowDrawList()->AddRectFilled({grid.left[name] - w.px(4), grid.top},
                                              {grid.right[misses] + w.px(4), grid.top + grid.height},
                                              ImGui::GetColorU32(ImGuiCol_Header, 0.55f), w.px(3));
  draw_name(w, grid, row);
  draw_time(w, session, grid, row, scale);
  if (row.scored())
    draw_score(w, session, grid, row);
  else
    draw_reason(session, grid, row);
  const TimeSeries& times = session.comparison.method_ms()[row.index];
  if (times.size() > 0) {
    ImGui::SetCursorScreenPos({grid.left[plot], grid.text_top()});
    w.sparkline(row.label("Times of"), times, {0, scale.axis_end}, compare::style(row.method).colour,
                {"Time of the method on a frame.", "ms"}, grid.right[plot] - grid.left[plot]);
  }
  draw_misses_switch(w, session, ui, grid, row);
  ImGui::SetCursorScreenPos({grid.left[name], grid.top + grid.height + w.px(row_gap)});
}

void draw_header(Widgets& w, const Session& session, Grid& grid) {
  grid.next_row();
  for (std::size_t i = time; i < column_count; ++i) {
    if (!is_shown(i, session)) continue;
    const auto at = static_cast<ColumnIndex>(i);
    grid.text(at, columns[i].label, true);
    grid.cell(w, at, std::string("Column ") + columns[i].label, columns[i].tooltip);
  }
  ImGui::SetCursorScreenPos({grid.left[name], grid.top});
  if (w.button("x###Close compare", "Closes the comparison (V).", grid.height))
    w.ask([](UiState& ui) { ui.lower = LowerView::none; });
  ImGui::SameLine();
  ImGui::SetNextItemWidth(grid.right[name] - ImGui::GetCursorScreenPos().x);
  draw_shown_methods(w, session);
  ImGui::SetCursorScreenPos({grid.left[name], grid.top + grid.height + w.px(row_gap)});
}

std::string footer(const Session& session) {
  const compare::CompareReport& report = session.comparison.report();
  std::string text = reference_sentence(report) + ".";
  if (report.reference) text.append(" ").append(grouped(report.true_contacts)).append(" true contacts.");
  const collide::Bodies& bodies = session.world().bodies();
  return fmt::format("{}  N = {} vertices, {} pairs.", text, grouped(bodies.vertex_count()),
                     grouped(compare::all_pair_tests(bodies, session.world().collision().self_collision)));
}

}  // namespace

float compare_height(std::size_t methods, float width, float scale) {
  const float line = ImGui::GetFontSize() + (2 * frame_padding + row_gap) * scale;
  const bool scrolls = width - 2 * ImGui::GetStyle().WindowPadding.x < min_content_width() * scale;
  return static_cast<float>(methods + 1) * line + ImGui::GetFontSize() + 2 * window_padding * scale +
         (scrolls ? ImGui::GetStyle().ScrollbarSize : 0);
}

void draw_compare(Widgets& w, const Session& session, const UiState& ui, const ScreenRect& area) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const compare::MethodSet shown = session.comparison.shown_methods();
  const auto rows = static_cast<std::size_t>(std::ranges::count(shown, true));
  const float outer = area.max.x - area.min.x;
  const bool scrolls = compare_height(rows, outer, w.px(1)) > area.max.y - area.min.y + 1;
  const float width =
      std::max(w.px(min_content_width()), outer - 2 * style.WindowPadding.x - (scrolls ? style.ScrollbarSize : 0));
  ImGui::SetNextWindowContentSize({width, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {style.WindowPadding.x, w.px(window_padding)});
  begin_dock("Compare methods###Compare", area, false, ImGuiWindowFlags_HorizontalScrollbar);
  w.keep_tooltips_off();
  ImGui::PopStyleVar();
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {w.px(2), w.px(frame_padding)});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {w.px(6), w.px(2)});
  Grid grid(w, session, ImGui::GetCursorScreenPos().x, width);
  draw_header(w, session, grid);
  const Scale scale = common_scale(session);
  const compare::CompareReport& report = session.comparison.report();
  const std::size_t driver = session.comparison.driver();
  std::optional<collide::MethodGroup> group;  // of the row before
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (!shown[i]) continue;
    const collide::Method& method = collide::method_table()[i];
    draw_row(w, session, ui, grid,
             {i, method, i < report.rows.size() ? &report.rows[i] : nullptr, group && group != method.group,
              i == driver, report.reference == i},
             scale);
    group = method.group;
  }
  w.text_line(footer(session));
  w.register_item(
      "Compare footing",
      "The method that finds the true contacts, and the size of the frame. §3 compares hashes with the number of "
      "vertices N, and pair tests with all pairs.");
  ImGui::PopStyleVar(2);
  ImGui::End();
}

}  // namespace app::ui
