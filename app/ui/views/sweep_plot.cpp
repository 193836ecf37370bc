#include "app/ui/views/sweep_plot.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "app/ui/widgets/method_mark.h"

namespace app::ui {
namespace {

// In design pixels.
constexpr float usual_radius = 4, mark_line = 1.5f, max_lane = 7, pick_radius = 9, label_gap = 6, axis_overhang = 6;
constexpr float max_band = 0.4f;  // of the plot's height, for points without error
constexpr glm::vec3 front_colour(0.15f), ring_colour(0.8f, 0.0f, 0.4f);
constexpr glm::vec3 major_line_colour(0.84f), minor_line_colour(0.94f), band_colour(0.92f, 0.96f, 0.92f);

/// Draws grey text at a point. `align`: the share of the text's width that lies left of the point.
void draw_grey_text(ImVec2 at, float align, const char* text) {
  const float left = at.x - align * ImGui::CalcTextSize(text).x;
  ImGui::GetWindowDrawList()->AddText({std::floor(left), std::floor(at.y)}, ImGui::GetColorU32(ImGuiCol_TextDisabled),
                                      text);
}

/// "0.01", "1", "100".
std::string power_of_ten(int exponent) { return fmt::format("{:g}", std::pow(10.0, exponent)); }

int exponent_below(double value) { return static_cast<int>(std::floor(std::log10(value))); }

std::optional<std::size_t> level_index(const compare::Configuration& c) {
  if (!collide::method_table()[c.method].uses_levels) return std::nullopt;
  return static_cast<std::size_t>(std::ranges::find(compare::sweep_levels, c.settings.levels) -
                                  compare::sweep_levels.begin());
}

}  // namespace

float SweepPlot::Axis::at(double value) const { return decade(std::log10(value)); }

float SweepPlot::Axis::decade(double exponent) const {
  return start + (end - start) * static_cast<float>((exponent - first) / (last - first));
}

void SweepPlot::set(const compare::SweepReport& report, const compare::MethodSet& methods) {
  points_.clear();
  methods_ = methods;
  for (std::size_t i = 0; i < report.rows.size() && report.reference; ++i) {
    const compare::SweepRow& row = report.rows[i];
    if (row.times.ms.empty() || !methods[row.configuration.method]) continue;
    const double ms = std::max(row.times.median(), 1e-6);  // a time may be below the clock's resolution
    points_.push_back({i, row.configuration.method, level_index(row.configuration), {ms, 1 - row.recall}});
  }
  std::vector<compare::Tradeoff> values;
  for (const Point& point : points_) values.push_back(point.value);
  front_ = compare::pareto_front(values);
}

void SweepPlot::draw(const Widgets& w, const ScreenRect& area, const Emphasis& emphasis) {
  place_points(w, area);
  draw_axes(w);
  for (const Point& point : points_) {
    const bool pale = emphasis.method && *emphasis.method != point.method;
    const compare::MethodStyle style = compare::style(collide::method_table()[point.method]);
    draw_marker(point.at, w.px(mark_radius(point.level)), style.marker, to_imgui(style.colour, pale ? 0.12f : 0.85f),
                w.px(mark_line));
  }
  draw_front(w);
  for (const Point& point : points_)
    if (emphasis.row == point.row) draw_ring(w, point.at);
}

void SweepPlot::draw_ring(const Widgets& w, ImVec2 at) {
  ImGui::GetWindowDrawList()->AddCircle(at, w.px(2 * usual_radius), to_imgui(ring_colour), 24, w.px(2));
}

float SweepPlot::mark_radius(std::optional<std::size_t> level) {
  return level ? 2.2f + 0.8f * static_cast<float>(*level) : usual_radius;
}

/// Fits the axes to whole decades, a few of them from the start, so that the axes rarely change while points come in.
void SweepPlot::place_points(const Widgets& w, const ScreenRect& area) {
  const auto& [min, max] = area;
  const float line = ImGui::GetTextLineHeight();
  int fastest = -2, slowest = 2, min_error = -2;
  for (const Point& point : points_) {
    fastest = std::min(fastest, exponent_below(point.value.ms));
    slowest = std::max(slowest, exponent_below(point.value.ms) + 1);
    if (point.value.error > 0) min_error = std::min(min_error, exponent_below(point.value.error));
  }
  const float label_width = ImGui::CalcTextSize(power_of_ten(std::min(min_error, -4)).c_str()).x;
  bottom_ = max.y - 2 * line - w.px(label_gap);
  const float top = min.y + line + w.px(10);
  // Each method has its own lane, so that points without error do not hide each other.
  const float lanes = static_cast<float>(std::ranges::count(methods_, true) + 2);
  const float lane_height = std::min(w.px(max_lane), max_band * (bottom_ - top) / lanes);
  time_ = {fastest, slowest, min.x + label_width + w.px(label_gap), max.x - w.px(12)};
  error_ = {0, min_error, top, bottom_ - lanes * lane_height};
  for (Point& point : points_) {
    const auto before =
        std::count(methods_.begin(), methods_.begin() + static_cast<std::ptrdiff_t>(point.method), true);
    const float lane = error_.end + lane_height * (static_cast<float>(before) + 1.5f);
    point.at = {time_.at(point.value.ms), point.value.error > 0 ? error_.at(point.value.error) : lane};
  }
}

void SweepPlot::draw_axes(const Widgets& w) const {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float top = error_.start - w.px(axis_overhang);
  draw->AddRectFilled({time_.start, top}, {time_.end, bottom_}, to_imgui(glm::vec3(1.0f)));
  draw->AddRectFilled({time_.start, error_.end}, {time_.end, bottom_}, to_imgui(band_colour));
  draw_time_axis(w, top);
  draw_error_axis(w);
  draw->AddRect({time_.start, top}, {time_.end, bottom_}, ImGui::GetColorU32(ImGuiCol_Border));
  draw_grey_text({time_.start, top - ImGui::GetTextLineHeight() - w.px(3)}, 0,
                 "Missed share (1 - recall); shaded: none missed, a row per method");
}

void SweepPlot::draw_time_axis(const Widgets& w, float top) const {
  const auto line = [&](float x, const glm::vec3& colour) {
    ImGui::GetWindowDrawList()->AddLine({x, top}, {x, bottom_}, to_imgui(colour));
  };
  for (int e = time_.first; e <= time_.last; ++e) {
    for (int digit = 2; digit < 10 && e < time_.last; ++digit)
      line(time_.at(digit * std::pow(10, e)), minor_line_colour);
    line(time_.decade(e), major_line_colour);
    draw_grey_text({time_.decade(e), bottom_ + w.px(3)}, 0.5f, power_of_ten(e).c_str());
  }
  draw_grey_text({time_.end, bottom_ + ImGui::GetTextLineHeight() + w.px(4)}, 1,
                 "Time per frame in ms, from scratch on one core");
}

void SweepPlot::draw_error_axis(const Widgets& w) const {
  const float line = ImGui::GetTextLineHeight();
  const auto label = [&](float y, const char* text) {
    draw_grey_text({time_.start - w.px(label_gap), y - 0.5f * line}, 1, text);
  };
  const float decade = error_.decade(-1) - error_.decade(0);
  const int every = std::max(1, static_cast<int>(std::ceil(line / decade)));  // labels must not overlap
  for (int e = error_.first; e >= error_.last; --e) {
    const float y = error_.decade(e);
    ImGui::GetWindowDrawList()->AddLine({time_.start, y}, {time_.end, y}, to_imgui(major_line_colour));
    if (e % every == 0) label(y, power_of_ten(e).c_str());
  }
  label(0.5f * (error_.end + bottom_), "0");
}

/// Draws the Pareto front as a stepped line: no point lies both left of it and below it.
void SweepPlot::draw_front(const Widgets& w) const {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImU32 colour = to_imgui(front_colour);
  for (std::size_t i = 0; i < front_.size(); ++i) {
    const ImVec2 here = points_[front_[i]].at;
    draw->AddCircle(here, w.px(usual_radius + 1.5f), colour, 16, w.px(1.5f));
    if (i + 1 == front_.size()) break;
    const ImVec2 next = points_[front_[i + 1]].at;
    draw->AddLine(here, {next.x, here.y}, colour, w.px(1.5f));
    draw->AddLine({next.x, here.y}, next, colour, w.px(1.5f));
  }
}

const SweepPlot::Point* SweepPlot::hit_test(const Widgets& w, ImVec2 mouse) const {
  const Point* best = nullptr;
  float min_squared = w.px(pick_radius) * w.px(pick_radius);
  for (const Point& point : points_) {
    const float dx = point.at.x - mouse.x, dy = point.at.y - mouse.y, squared = dx * dx + dy * dy;
    if (squared > min_squared) continue;
    min_squared = squared;
    best = &point;
  }
  return best;
}

}  // namespace app::ui
