#include "app/panel/widgets.h"

#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace app {

const Recorder::Widget* Recorder::find(std::string_view label) const {
  const auto found = std::ranges::find(widgets, label, &Widget::label);
  return found == widgets.end() ? nullptr : &*found;
}

ImU32 to_imgui(const glm::vec3& colour, float alpha) {
  return ImGui::ColorConvertFloat4ToU32({colour.x, colour.y, colour.z, alpha});
}

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

void Widgets::done(const char* label, const char* tooltip) {
  if (recorder_) {
    const bool enabled = ImGui::GetStyle().Alpha >= usual_alpha_;  // ImGui::BeginDisabled() lowers it
    const std::string_view whole(label);
    const auto name = whole.rfind("###");  // ImGui's way of a fixed name behind a changing text
    recorder_->widgets.push_back({std::string(whole.substr(name == whole.npos ? 0 : name + 3)), ImGui::GetItemRectMin(),
                                  ImGui::GetItemRectMax(), enabled});
  }
  explain(label, tooltip);
}

void Widgets::explain(const char* label, const char* tooltip) {
  if (!tooltip || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  if (hover_.label != label || ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    hover_.label = label;
    hover_.seconds = 0;
  }
  hover_.seconds += ImGui::GetIO().DeltaTime;
  if (hover_.seconds >= Hover::delay) show_tooltip(tooltip);
}

void Widgets::done_with_number(const char* label, const char* tooltip) {
  constexpr const char* how = "Drag it sideways, or double-click it to type a value.";
  done(label, tooltip ? joined(tooltip, "\n", how).c_str() : how);
}

namespace {

/// Beside the window that the last item is in, or above or below a wide one, so that no neighbour is covered.
ImVec2 tooltip_place(const ImVec2& size, float gap) {
  const ImVec2 display = ImGui::GetIO().DisplaySize, item = ImGui::GetItemRectMin();
  const ImVec2 window = ImGui::GetWindowPos(), extent = ImGui::GetWindowSize();
  const float right = window.x + extent.x + gap, left = window.x - gap - size.x;
  const bool wide = extent.x > 0.5f * display.x;
  const auto inside = [](float at, float length, float whole) {
    return std::clamp(at, 0.0f, std::max(0.0f, whole - length));
  };
  if (!wide && right + size.x <= display.x) return {right, inside(item.y, size.y, display.y)};
  if (!wide && left >= 0) return {left, inside(item.y, size.y, display.y)};
  const bool above = window.y + 0.5f * extent.y > 0.5f * display.y;
  const float y = above ? window.y - gap - size.y : window.y + extent.y + gap;
  const float beside_item = above ? item.y - gap - size.y : ImGui::GetItemRectMax().y + gap;
  const bool outside = y >= 0 && y + size.y <= display.y;
  return {inside(item.x, size.x, display.x), inside(outside ? y : beside_item, size.y, display.y)};
}

}  // namespace

void Widgets::show_tooltip(const char* text) const {
  const float wrap = px(320);
  const ImVec2 pad = ImGui::GetStyle().WindowPadding, lines = ImGui::CalcTextSize(text, nullptr, false, wrap);
  const ImVec2 size{lines.x + 2 * pad.x, lines.y + 2 * pad.y}, at = tooltip_place(size, px(6));
  if (recorder_) recorder_->widgets.push_back({"Tooltip", at, {at.x + size.x, at.y + size.y}, true});
  ImGui::SetNextWindowPos(at);
  ImGui::PushStyleVar(ImGuiStyleVar_Alpha, usual_alpha_);  // what explains a disabled widget is not faint itself
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(wrap + pad.x);
  ImGui::TextUnformatted(text);
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
  ImGui::PopStyleVar();
}

bool Widgets::button(const char* label, const char* tooltip, float width) {
  const bool pressed = ImGui::Button(label, {width, 0});
  done(label, tooltip);
  return pressed;
}

bool Widgets::radio(const char* label, bool active, const char* tooltip) {
  const bool pressed = ImGui::RadioButton(label, active);
  done(label, tooltip);
  return pressed;
}

bool Widgets::checkbox(const char* label, bool& value, const char* tooltip) {
  const bool changed = ImGui::Checkbox(label, &value);
  done(label, tooltip);
  return changed;
}

bool Widgets::section(const char* label, bool open_at_first) {
  if (const auto kept = sections_.find(label); kept != sections_.end())
    ImGui::SetNextItemOpen(kept->second, ImGuiCond_Once);
  const bool open = ImGui::CollapsingHeader(label, open_at_first ? ImGuiTreeNodeFlags_DefaultOpen : 0);
  sections_[label] = open;
  done(label, nullptr);
  return open;
}

namespace {

std::string hidden(const char* label) { return std::string("##") + label; }

/// Sliders write their value in the middle, where ImGui's own grab would stand in its way.
class HiddenGrab {
 public:
  HiddenGrab() {
    for (const ImGuiCol which : {ImGuiCol_SliderGrab, ImGuiCol_SliderGrabActive}) ImGui::PushStyleColor(which, {});
  }
  ~HiddenGrab() { ImGui::PopStyleColor(2); }
};

/// How far a value is between the ends of a slider, 0 .. 1.
float place_of(double value, double least, double most, bool logarithmic) {
  const double place =
      logarithmic ? std::log(value / least) / std::log(most / least) : (value - least) / (most - least);
  return static_cast<float>(std::clamp(place, 0.0, 1.0));
}

/// A bar and a grab along the lower edge of the last item, below its text. steps: of whole numbers; 0: no steps.
void mark_slider(float place, float steps, float bar) {
  const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
  constexpr float border = 2;  // where ImGui's grab ends
  const float room = max.x - min.x - 2 * border;
  const float grab = std::min(room, std::max(ImGui::GetStyle().GrabMinSize, steps > 0 ? room / (steps + 1) : 0));
  const float left = min.x + border + place * (room - grab);
  const ImU32 colour = ImGui::GetColorU32(ImGui::IsItemActive() ? ImGuiCol_SliderGrabActive : ImGuiCol_SliderGrab);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled({min.x + border, max.y - bar}, {left, max.y}, ImGui::GetColorU32(ImGuiCol_SliderGrab, 0.35f));
  draw->AddRectFilled({left, max.y - 2 * bar}, {left + grab, max.y}, colour, bar);
}

constexpr float slider_bar = 2.5f;  // design pixels
constexpr ImGuiSliderFlags kept_inside = ImGuiSliderFlags_AlwaysClamp;

/// By double-click. One in a field that is open already selects a word there.
bool opens_field() { return ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && !ImGui::IsAnyItemActive(); }

/// ImGui's sliders open a field for typing by Ctrl+click alone, its drags by double-click too.
struct OpensByDoubleClick {
  const bool before = ImGui::GetIO().KeyCtrl;
  OpensByDoubleClick() { ImGui::GetIO().KeyCtrl |= opens_field(); }
  ~OpensByDoubleClick() { ImGui::GetIO().KeyCtrl = before; }
};

}  // namespace

template <class Value, class Show>
bool Widgets::slide(const char* label, Value& value, const Show& show) {
  const Value now = value;
  const bool twice = opens_field() && hover_.pressed == label;
  if (twice) value = static_cast<Value>(hover_.before);
  const bool changed = [&] {
    const HiddenGrab hide;
    const OpensByDoubleClick opens;
    return show(twice);
  }();
  if (twice) {
    if (!ImGui::IsItemActive()) value = now;  // the second click was beside it
    hover_.pressed.clear();
  } else if (ImGui::IsItemActivated()) {
    hover_.pressed = label;
    hover_.before = static_cast<double>(now);
  }
  return changed || value != now;
}

bool Widgets::slider(const char* label, int& value, int least, int most, const char* format, const char* tooltip) {
  const bool changed = slide(label, value, [&](bool) {
    return ImGui::SliderInt(hidden(label).c_str(), &value, least, most, format, kept_inside);
  });
  mark_slider(place_of(value, least, most, false), static_cast<float>(most - least), px(slider_bar));
  done_with_number(label, tooltip);
  return changed;
}

bool Widgets::slider(const char* label, float& value, float least, float most, const char* format, const char* tooltip,
                     bool logarithmic) {
  const ImGuiSliderFlags flags = kept_inside | (logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
  const bool changed = slide(label, value, [&](bool) {
    return ImGui::SliderFloat(hidden(label).c_str(), &value, least, most, format, flags);
  });
  // ImGui's logarithmic sliders begin where the shown digits do, if at 0.
  const double begin = logarithmic ? std::max(double{least}, std::pow(0.1, ImParseFormatPrecision(format, 3))) : least;
  mark_slider(place_of(double{value}, begin, double{most}, logarithmic), 0, px(slider_bar));
  done_with_number(label, tooltip);
  return changed;
}

bool Widgets::slider(const char* label, std::uint32_t& value, std::uint32_t least, std::uint32_t most,
                     const char* tooltip) {
  const bool changed = slide(label, value, [&](bool typed) {
    return ImGui::SliderScalar(hidden(label).c_str(), ImGuiDataType_U32, &value, &least, &most, typed ? "%u" : "",
                               kept_inside | ImGuiSliderFlags_Logarithmic);
  });
  mark_slider(place_of(value, least, most, true), 0, px(slider_bar));
  done_with_number(label, tooltip);
  return changed;
}

bool Widgets::drag(const char* label, glm::dvec3& value, float least, float most, const char* tooltip) {
  constexpr float metres_a_pixel = 0.01f;
  std::array<float, 3> shown{static_cast<float>(value.x), static_cast<float>(value.y), static_cast<float>(value.z)};
  const bool changed =
      ImGui::DragFloat3(hidden(label).c_str(), shown.data(), metres_a_pixel, least, most, "%.2f", kept_inside);
  done_with_number(label, tooltip);
  const bool usable = changed && std::ranges::all_of(shown, [](float v) { return std::isfinite(v); });
  if (usable) value = {shown[0], shown[1], shown[2]};
  return usable;
}

bool Widgets::number(const char* label, std::uint32_t& value, std::uint32_t least, std::uint32_t most,
                     const char* tooltip) {
  const bool changed = ImGui::InputScalar(hidden(label).c_str(), ImGuiDataType_U32, &value);
  value = std::clamp(value, least, most);
  done(label, tooltip);
  return changed;
}

bool Widgets::text(const char* label, std::string& value, const char* hint, const char* tooltip) {
  std::array<char, 4096> typed{};  // as long as a path may be
  value.copy(typed.data(), typed.size() - 1);
  if (ImGui::InputTextWithHint(hidden(label).c_str(), hint, typed.data(), typed.size(),
                               ImGuiInputTextFlags_AutoSelectAll))
    value = typed.data();
  const bool entered = ImGui::IsItemDeactivated() && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter));
  done(label, tooltip);
  return entered;
}

bool Widgets::begin_choices(const char* label, const char* preview, const char* tooltip, ImGuiComboFlags flags) {
  const bool open = ImGui::BeginCombo(hidden(label).c_str(), preview, flags | ImGuiComboFlags_HeightLarge);
  // While the list is open, the last item is inside it, so the combo itself is noted only when closed.
  if (!open) done(label, tooltip);
  if (open && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) ImGui::CloseCurrentPopup();
  return open;
}

bool Widgets::choice(const char* label, bool selected, const char* tooltip) {
  const bool chosen = ImGui::Selectable(label, selected);
  done(label, tooltip);
  return chosen;
}

bool Widgets::heading(const char* label, const char* tooltip) {
  ImGui::Spacing();
  ImGui::AlignTextToFramePadding();
  const char* id = std::strstr(label, "###");
  ImGui::TextUnformatted(label, id);
  const float side = ImGui::GetFrameHeight();
  ImGui::SameLine(ImGui::GetContentRegionMax().x - side);
  return button(joined("x###Close ", id ? id + 3 : label).c_str(), tooltip, side);
}

void Widgets::row(const char* label, float column) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", label);
  ImGui::SameLine(column);
  ImGui::SetNextItemWidth(-FLT_MIN);
}

namespace {

void text_in_line(const std::string& text, float place) {
  const float space = ImGui::GetContentRegionAvail().x;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float left = std::max(0.0f, space - ImGui::CalcTextSize(text.c_str()).x) * place;
  ImGui::Dummy({space, ImGui::GetTextLineHeight()});
  ImGui::GetWindowDrawList()->AddText({std::floor(at.x + left), at.y}, ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
}

}  // namespace

void Widgets::line(const std::string& text) {
  if (ImGui::CalcTextSize(text.c_str()).x > ImGui::GetContentRegionAvail().x)
    ImGui::TextWrapped("%s", text.c_str());
  else
    text_in_line(text, 0.0f);
}
void Widgets::value(const std::string& text) { text_in_line(text, 1.0f); }

void Widgets::figure(const char* label, const std::string& value_text, const char* tooltip) {
  ImGui::BeginGroup();
  ImGui::TextDisabled("%s", label);
  ImGui::SameLine();
  value(value_text);
  ImGui::EndGroup();
  done(label, tooltip);
}

void Widgets::chip(const glm::vec3& colour, float line_height) {
  const float side = ImGui::GetFontSize() * 0.7f;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float y = at.y + 0.5f * (line_height - side);
  ImGui::GetWindowDrawList()->AddRectFilled({at.x, y}, {at.x + side, y + side}, to_imgui(colour), px(2));
  ImGui::Dummy({side, line_height});
}

void Widgets::dot(const glm::vec3& colour) {
  const float radius = ImGui::GetFontSize() * 0.36f;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 centre{at.x + radius, at.y + 0.5f * ImGui::GetTextLineHeight()};
  ImGui::GetWindowDrawList()->AddCircleFilled(centre, radius, to_imgui(colour), 24);
  ImGui::Dummy({2 * radius + px(2), ImGui::GetTextLineHeight()});
  ImGui::SameLine();
}

namespace {

std::string range_of(const Axis& axis, const char* unit) {
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "The last %zu values, from %g to %g %s.", Ring::capacity,
                static_cast<double>(axis.bottom), static_cast<double>(axis.top), unit);
  return text.data();
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
  ImGui::InvisibleButton(hidden(label).c_str(), size);
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
