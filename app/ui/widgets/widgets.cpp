#include "app/ui/widgets/widgets.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "app/render/palette.h"
#include "app/ui/state/ui_state.h"

namespace app::ui {
namespace {

bool is_pressed(ImGuiKey key) {
#if IMGUI_VERSION_NUM >= 18700
  return ImGui::IsKeyPressed(key);
#else
  return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key));
#endif
}

/// Returns a place beside the last item's window, or else below or above the item, that covers no results.
ImVec2 tooltip_position(const ImVec2& size, float gap, float max_shift, const std::vector<ScreenRect>& results) {
  const ImVec2 display = ImGui::GetIO().DisplaySize, item = ImGui::GetItemRectMin(), end = ImGui::GetItemRectMax();
  const ImVec2 window = ImGui::GetWindowPos(), extent = ImGui::GetWindowSize();
  const auto inside = [](float at, float length, float whole) {
    return std::clamp(at, 0.0f, std::max(0.0f, whole - length));
  };
  const float x = std::max(0.0f, std::min(item.x, std::min(window.x + extent.x, display.x) - size.x));
  const float y = inside(item.y, size.y, display.y);
  const float right = window.x + extent.x + gap;
  std::vector<ImVec2> places{{right, y}};
  for (const ScreenRect& result : results)
    for (const float beyond : {result.max.y + gap, result.min.y - gap - size.y})
      if (std::abs(beyond - y) <= max_shift) places.push_back({right, beyond});
  places.insert(places.end(), {{x, window.y + extent.y + gap},
                               {x, window.y - gap - size.y},
                               {window.x - gap - size.x, y},
                               {x, end.y + gap},
                               {x, item.y - gap - size.y}});
  const auto is_free = [&](const ImVec2& at) {
    const bool shown = at.x >= 0 && at.y >= 0 && at.x + size.x <= display.x && at.y + size.y <= display.y;
    const ScreenRect tooltip{at, {at.x + size.x, at.y + size.y}};
    return shown && std::ranges::none_of(results, [&](const ScreenRect& r) { return overlap(tooltip, r); });
  };
  const auto found = std::ranges::find_if(places, is_free);
  return found != places.end() ? *found : ImVec2{x, inside(end.y + gap, size.y, display.y)};
}

/// Draws text in the rest of the line. `align`: 0 is flush left, 1 flush right.
void draw_text_in_line(const std::string& text, float align) {
  const float space = ImGui::GetContentRegionAvail().x;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float left = std::max(0.0f, space - ImGui::CalcTextSize(text.c_str()).x) * align;
  ImGui::Dummy({space, ImGui::GetTextLineHeight()});
  ImGui::GetWindowDrawList()->AddText({std::floor(at.x + left), at.y}, ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
}

}  // namespace

const WidgetRecorder::Widget* WidgetRecorder::find(std::string_view label) const {
  const auto found = std::ranges::find(widgets, label, &Widget::label);
  return found == widgets.end() ? nullptr : &*found;
}

ImU32 to_imgui(const glm::vec3& colour, float alpha) {
  return ImGui::ColorConvertFloat4ToU32({colour.x, colour.y, colour.z, alpha});
}

std::string wrapped(std::string_view text, float width) {
  std::string lines(text);
  std::size_t line = 0, last = lines.npos;  // where the line begins, and its last space
  for (std::size_t i = 0; i <= lines.size(); ++i) {
    if (i < lines.size() && lines[i] != ' ' && lines[i] != '\n') continue;
    if (last != lines.npos && ImGui::CalcTextSize(&lines[line], &lines[i]).x > width) {
      lines[last] = '\n';
      line = last + 1;
    }
    const bool before_unit = i > 0 && std::isdigit(static_cast<unsigned char>(lines[i - 1])) &&
                             std::min(lines.find_first_of(" \n", i + 1), lines.size()) <= i + 3;
    if (i < lines.size() && lines[i] == '\n')
      line = i + 1, last = lines.npos;
    else if (!before_unit)
      last = i;
  }
  return lines;
}

void draw_colour_scale(ImVec2 min, float width, float bottom, int steps, glm::vec3 (*colour)(float)) {
  const float count = static_cast<float>(steps);
  for (int i = 0; i < steps; ++i) {
    const float x0 = min.x + width * static_cast<float>(i) / count,
                x1 = min.x + width * static_cast<float>(i + 1) / count;
    const glm::vec3 fill = colour((static_cast<float>(i) + 0.5f) / count);
    ImGui::GetWindowDrawList()->AddRectFilled({x0, min.y}, {x1, bottom}, to_imgui(fill));
  }
}

void InputState::update(float min_move) {
  last_results = std::exchange(results, {});
  const ImVec2 at = ImGui::GetIO().MousePos;
  if (ImGui::IsAnyMouseDown()) {
    wait_for_mouse(at);
  } else if (std::max(std::abs(at.x - clicked_at.x), std::abs(at.y - clicked_at.y)) > min_move) {
    clicked = false;
  }
}

void Widgets::register_item(std::string_view label, std::string_view tooltip) {
  if (recorder_) {
    const bool enabled = ImGui::GetStyle().Alpha >= usual_alpha_;  // ImGui::BeginDisabled() lowers it
    const auto name = label.rfind("###");  // in ImGui, the identifier of an item follows this mark
    recorder_->widgets.push_back({std::string(label.substr(name == label.npos ? 0 : name + 3)), ImGui::GetItemRectMin(),
                                  ImGui::GetItemRectMax(), enabled});
  }
  tooltip_if_hovered(label, tooltip);
}

void Widgets::tooltip_if_hovered(std::string_view label, std::string_view tooltip) {
  if (tooltip.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  if (input_.hovered != label || input_.clicked) {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.MouseDelta.x == 0 && io.MouseDelta.y == 0) input_.wait_for_mouse(io.MousePos);  // a key brought the widget
    input_.hovered = label;
    input_.seconds = 0;
  } else {  // the first frame may follow a long wait
    input_.seconds += ImGui::GetIO().DeltaTime;
  }
  if (input_.seconds >= InputState::tooltip_delay) show_tooltip(tooltip);
}

void Widgets::keep_tooltips_off() {
  const ImVec2 min = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  input_.results.push_back({min, {min.x + size.x, min.y + size.y}});
}

void Widgets::show_tooltip(std::string_view text) const {
  if (input_.clicked) return;
  const std::string lines = wrapped(text, px(250));
  const ImVec2 pad = ImGui::GetStyle().WindowPadding, extent = ImGui::CalcTextSize(lines.c_str());
  const ImVec2 size{extent.x + 2 * pad.x, extent.y + 2 * pad.y};
  // Far from the item only beside an open list, whose other lines stay legible.
  const bool list = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
  const float max_shift = list ? ImGui::GetIO().DisplaySize.y : px(80);
  const ImVec2 at = tooltip_position(size, px(6), max_shift, input_.last_results);
  if (recorder_) {
    recorder_->widgets.push_back({"Tooltip", at, {at.x + size.x, at.y + size.y}, true});
    recorder_->tooltip = text;
  }
  ImGui::SetNextWindowPos(at);
  ImGui::PushStyleVar(ImGuiStyleVar_Alpha, usual_alpha_);  // the tooltip of a disabled widget is not faint
  ImGui::BeginTooltip();
  ImGui::TextUnformatted(lines.c_str());
  ImGui::EndTooltip();
  ImGui::PopStyleVar();
}

bool Widgets::button(std::string_view label, std::string_view tooltip, float width, bool enabled) {
  const Disabled off(!enabled);
  return register_item(ImGui::Button(std::string(label).c_str(), {width, 0}), label, tooltip);
}

bool Widgets::checkbox(std::string_view label, bool value, std::string_view tooltip) {
  return register_item(ImGui::Checkbox(std::string(label).c_str(), &value), label, tooltip);
}

bool Widgets::section(std::string_view label) {
  const std::string name(label);
  const auto stored = sections_.find(name);
  const bool was_open = stored != sections_.end() && stored->second;
  ImGui::SetNextItemOpen(was_open);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ImGui::GetStyle().FramePadding.x, px(2)});
  const bool open = ImGui::CollapsingHeader(name.c_str());
  ImGui::PopStyleVar();
  if (open != was_open) ask([name, open](UiState& ui) { ui.sections[name] = open; });
  return register_item(open, label, "");
}

bool Widgets::text_field(std::string_view label, const std::string& value, const char* hint, std::string_view tooltip,
                         std::string& (*place)(session::Session&, UiState&)) {
  std::array<char, 4096> typed{};  // the longest path
  value.copy(typed.data(), typed.size() - 1);
  if (ImGui::InputTextWithHint(fmt::format("##{}", label).c_str(), hint, typed.data(), typed.size(),
                               ImGuiInputTextFlags_AutoSelectAll))
    ask([=, text = std::string(typed.data())](session::Session& s, UiState& ui) { place(s, ui) = text; });
  return register_item(ImGui::IsItemDeactivated() && is_pressed(ImGuiKey_Enter), label, tooltip);
}

bool Widgets::begin_combo(std::string_view label, std::string_view preview, std::string_view tooltip) {
  const bool open =
      ImGui::BeginCombo(fmt::format("##{}", label).c_str(), std::string(preview).c_str(), ImGuiComboFlags_HeightLarge);
  // While the list is open, the last item is inside it, so the combo itself is recorded only when closed.
  if (!open) register_item(label, tooltip);
  if (open && is_pressed(ImGuiKey_Escape)) ImGui::CloseCurrentPopup();
  return open;
}

bool Widgets::combo_item(std::string_view label, bool selected, std::string_view tooltip) {
  return register_item(ImGui::Selectable(std::string(label).c_str(), selected), label, tooltip);
}

bool Widgets::closable_heading(std::string_view label, std::string_view tooltip) {
  ImGui::Spacing();
  ImGui::AlignTextToFramePadding();
  const auto mark = label.find("###");
  const std::string_view title = label.substr(0, mark), id = mark == label.npos ? label : label.substr(mark + 3);
  ImGui::TextUnformatted(title.data(), title.data() + title.size());
  const float side = ImGui::GetFrameHeight();
  ImGui::SameLine(ImGui::GetContentRegionMax().x - side);
  return button(fmt::format("x###Close {}", id), tooltip, side);
}

void Widgets::row_label(std::string_view label, float column) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", std::string(label).c_str());
  ImGui::SameLine(column);
  ImGui::SetNextItemWidth(-FLT_MIN);
}

void Widgets::text_line(const std::string& text) {
  if (ImGui::CalcTextSize(text.c_str()).x > ImGui::GetContentRegionAvail().x)
    paragraph(text);
  else
    draw_text_in_line(text, 0.0f);
}
void Widgets::right_text(const std::string& text) { draw_text_in_line(text, 1.0f); }

void Widgets::paragraph(const std::string& text) {
  ImGui::TextWrapped("%s", wrapped(text, ImGui::GetContentRegionAvail().x).c_str());
}

void Widgets::wrapped_text(std::string_view label, const std::string& text, bool problem) {
  if (problem) ImGui::PushStyleColor(ImGuiCol_Text, to_imgui(render::status_red));
  paragraph(text);
  if (problem) ImGui::PopStyleColor();
  register_item(label);
}

void Widgets::pale_text(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  paragraph(text);
  ImGui::PopStyleColor();
}

void Widgets::figure(std::string_view label, const std::string& value_text, std::string_view tooltip) {
  ImGui::BeginGroup();
  ImGui::TextDisabled("%s", std::string(label).c_str());
  ImGui::SameLine();
  right_text(value_text);
  ImGui::EndGroup();
  register_item(label, tooltip);
}

void Widgets::swatch(const glm::vec3& colour) {
  const float side = ImGui::GetFontSize() * 0.7f, line_height = ImGui::GetTextLineHeight();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float y = at.y + 0.5f * (line_height - side);
  ImGui::GetWindowDrawList()->AddRectFilled({at.x, y}, {at.x + side, y + side}, to_imgui(colour), px(2));
  ImGui::Dummy({side, line_height});
  ImGui::SameLine();
}

void Widgets::dot(const glm::vec3& colour) {
  const float radius = ImGui::GetFontSize() * 0.36f;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 centre{at.x + radius, at.y + 0.5f * ImGui::GetTextLineHeight()};
  ImGui::GetWindowDrawList()->AddCircleFilled(centre, radius, to_imgui(colour), 24);
  ImGui::Dummy({2 * radius + px(2), ImGui::GetTextLineHeight()});
  ImGui::SameLine();
}

}  // namespace app::ui
