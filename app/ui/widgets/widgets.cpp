#include "app/ui/widgets/widgets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include <fmt/core.h>

namespace app {
namespace {

bool is_pressed(ImGuiKey key) {
#if IMGUI_VERSION_NUM >= 18700
  return ImGui::IsKeyPressed(key);
#else
  return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key));
#endif
}

}  // namespace

const Recorder::Widget* Recorder::find(std::string_view label) const {
  const auto found = std::ranges::find(widgets, label, &Widget::label);
  return found == widgets.end() ? nullptr : &*found;
}

ImU32 to_imgui(const glm::vec3& colour, float alpha) {
  return ImGui::ColorConvertFloat4ToU32({colour.x, colour.y, colour.z, alpha});
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

bool Widgets::number(const char* label, std::uint32_t& value, std::uint32_t least, std::uint32_t most,
                     const char* tooltip) {
  const bool changed = ImGui::InputScalar(fmt::format("##{}", label).c_str(), ImGuiDataType_U32, &value);
  value = std::clamp(value, least, most);
  done(label, tooltip);
  return changed;
}

bool Widgets::text(const char* label, std::string& value, const char* hint, const char* tooltip) {
  std::array<char, 4096> typed{};  // as long as a path may be
  value.copy(typed.data(), typed.size() - 1);
  if (ImGui::InputTextWithHint(fmt::format("##{}", label).c_str(), hint, typed.data(), typed.size(),
                               ImGuiInputTextFlags_AutoSelectAll))
    value = typed.data();
  const bool entered = ImGui::IsItemDeactivated() && is_pressed(ImGuiKey_Enter);
  done(label, tooltip);
  return entered;
}

bool Widgets::begin_choices(const char* label, const char* preview, const char* tooltip, ImGuiComboFlags flags) {
  const bool open = ImGui::BeginCombo(fmt::format("##{}", label).c_str(), preview, flags | ImGuiComboFlags_HeightLarge);
  // While the list is open, the last item is inside it, so the combo itself is noted only when closed.
  if (!open) done(label, tooltip);
  if (open && is_pressed(ImGuiKey_Escape)) ImGui::CloseCurrentPopup();
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
  return button(fmt::format("x###Close {}", id ? id + 3 : label).c_str(), tooltip, side);
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

}  // namespace app
