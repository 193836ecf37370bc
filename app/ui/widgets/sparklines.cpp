// The widgets that plot values over time.

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include <fmt/core.h>

#include "app/ui/widgets/widgets.h"

namespace app::ui {

float axis_end(float max, float min_end) {
  assert(min_end > 0);
  float end = min_end;
  for (int i = 0; end < max; ++i) end *= i % 3 == 1 ? 2.5f : 2.0f;
  return end;
}

Axis axis_around(const TimeSeries& series, float min_length) {
  const float range = axis_end(series.max() - series.min(), min_length), grid = range / 4;
  const float bottom = grid * std::floor(series.min() / grid);
  return {bottom, bottom + range + grid};
}

namespace {

std::string curve_tooltip(const Widgets::Quantity& quantity, const Axis& axis) {
  return fmt::format("{} The curve shows the last {} values, from {:g} to {:g}{}{}.", quantity.meaning,
                     TimeSeries::capacity, axis.bottom, axis.top, *quantity.unit ? " " : "", quantity.unit);
}

}  // namespace

void Widgets::curve(std::string_view label, const std::string& text, const TimeSeries& series, const Axis& axis,
                    const glm::vec3& colour, const Quantity& quantity) {
  constexpr float value_end = 170;  // design pixels: right end of the numbers
  const float end = px(value_end), start = ImGui::GetCursorPosX();
  ImGui::BeginGroup();
  ImGui::TextDisabled("%s", std::string(label).c_str());
  ImGui::SameLine(end - ImGui::CalcTextSize(text.c_str()).x);
  ImGui::TextUnformatted(text.c_str());
  ImGui::EndGroup();
  tooltip_if_hovered(label, curve_tooltip(quantity, axis));
  ImGui::SameLine(start + end + px(10));
  sparkline(label, series, axis, colour, quantity);
}

void Widgets::sparkline(std::string_view label, const TimeSeries& series, const Axis& axis, const glm::vec3& colour,
                        const Quantity& quantity, float width) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 size{width > 0 ? width : ImGui::GetContentRegionAvail().x, ImGui::GetTextLineHeight()};
  ImGui::InvisibleButton(fmt::format("##{}", label).c_str(), size);
  register_item(label, curve_tooltip(quantity, axis));

  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddLine({at.x, at.y + size.y}, {at.x + size.x, at.y + size.y}, ImGui::GetColorU32(ImGuiCol_Border));
  std::array<ImVec2, TimeSeries::capacity> points;
  int count = 0;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const float x =
        static_cast<float>(TimeSeries::capacity - series.size() + i) / static_cast<float>(TimeSeries::capacity - 1);
    const float y = 1.0f - std::clamp((series[i] - axis.bottom) / (axis.top - axis.bottom), 0.0f, 1.0f);
    const ImVec2 point{at.x + x * size.x, at.y + y * size.y};
    // The middle one of three points at one height is left out.
    const auto level = [&](int before) { return points[static_cast<std::size_t>(count - before)].y == point.y; };
    if (count >= 2 && level(1) && level(2)) --count;
    points[static_cast<std::size_t>(count++)] = point;
  }
  // ImGui draws lines of whole pixels with a third of the triangles.
  draw->AddPolyline(points.data(), count, to_imgui(colour), ImDrawFlags_None, std::max(1.0f, std::round(px(1.25f))));
}

}  // namespace app::ui
