// The widgets of values over time.

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "app/ui/widgets/widgets.h"

namespace app {

float axis_end(float most, float least) {
  float end = least;
  for (int i = 0; end < most; ++i) end *= i % 3 == 1 ? 2.5f : 2.0f;
  return end;
}

Axis axis_around(const Ring& ring, float least) {
  const float range = axis_end(ring.largest() - ring.smallest(), least), grid = range / 4;
  const float bottom = grid * std::floor(ring.smallest() / grid);
  return {bottom, bottom + range + grid};
}

namespace {

std::string range_of(const Axis& axis, const char* unit) {
  return fmt::format("The last {} values, from {:g} to {:g} {}.", Ring::capacity, axis.bottom, axis.top, unit);
}

}  // namespace

void Widgets::curve(const char* label, const std::string& text, const Ring& ring, const Axis& axis,
                    const glm::vec3& colour, const char* unit) {
  constexpr float value_end = 170;  // design pixels: where numbers end and curves begin
  const float end = px(value_end), start = ImGui::GetCursorPosX();
  ImGui::BeginGroup();
  ImGui::TextDisabled("%s", label);
  ImGui::SameLine(end - ImGui::CalcTextSize(text.c_str()).x);
  ImGui::TextUnformatted(text.c_str());
  ImGui::EndGroup();
  explain(label, range_of(axis, unit).c_str());
  ImGui::SameLine(start + end + px(10));
  sparkline(label, ring, axis, colour, unit);
}

void Widgets::sparkline(const char* label, const Ring& ring, const Axis& axis, const glm::vec3& colour,
                        const char* unit, float width) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 size{width > 0 ? width : ImGui::GetContentRegionAvail().x, ImGui::GetTextLineHeight()};
  ImGui::InvisibleButton(fmt::format("##{}", label).c_str(), size);
  done(label, range_of(axis, unit).c_str());

  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddLine({at.x, at.y + size.y}, {at.x + size.x, at.y + size.y}, ImGui::GetColorU32(ImGuiCol_Border));
  std::array<ImVec2, Ring::capacity> points;
  int count = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const float x = static_cast<float>(Ring::capacity - ring.size() + i) / static_cast<float>(Ring::capacity - 1);
    const float y = 1.0f - std::clamp((ring[i] - axis.bottom) / (axis.top - axis.bottom), 0.0f, 1.0f);
    const ImVec2 point{at.x + x * size.x, at.y + y * size.y};
    const auto level = [&](int before) { return points[static_cast<std::size_t>(count - before)].y == point.y; };
    if (count >= 2 && level(1) && level(2)) --count;
    points[static_cast<std::size_t>(count++)] = point;
  }
  // ImGui takes a third of the triangles for lines of whole pixels.
  draw->AddPolyline(points.data(), count, to_imgui(colour), ImDrawFlags_None, std::max(1.0f, std::round(px(1.25f))));
}

}  // namespace app
