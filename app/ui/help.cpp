#include "app/ui/parts.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include "app/ui/state/shortcuts.h"

namespace app::ui {
namespace {

constexpr float key_width = 86, between_columns = 24;  // design pixels

using Entries = std::vector<HelpLine>;  // an entry without input and text is an empty line

Entries all_entries() {
  Entries entries;
  for (const Shortcut& shortcut : shortcuts())
    if (!shortcut.keys_text.empty()) entries.push_back({shortcut.keys_text, shortcut.text});
  entries.push_back({"", ""});
  for (const render::OverlayRow& row : render::overlay_table)
    entries.push_back({std::string_view(&row.shortcut, 1), row.label});
  entries.push_back({"", ""});
  entries.insert(entries.end(), mouse_actions().begin(), mouse_actions().end());
  return entries;
}

float width_of(const Widgets& w, const Entries& entries) {
  float widest = 0;
  for (const HelpLine& e : entries)
    widest = std::max(widest, ImGui::CalcTextSize(e.text.data(), e.text.data() + e.text.size()).x);
  return w.px(key_width) + widest;
}

/// Draws the entries from `left` (x) on.
void draw_entries(Widgets& w, std::span<const HelpLine> entries, float left) {
  ImGui::BeginGroup();
  for (const HelpLine& e : entries) {
    ImGui::SetCursorPosX(left);
    ImGui::TextUnformatted(e.input.data(), e.input.data() + e.input.size());
    ImGui::SameLine();
    ImGui::SetCursorPosX(left + w.px(key_width));
    ImGui::TextDisabled("%.*s", static_cast<int>(e.text.size()), e.text.data());
    w.register_item(fmt::format("Help {}", e.text));
  }
  ImGui::EndGroup();
}

}  // namespace

void draw_help(Widgets& w, const ScreenRect& area) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const Entries entries = all_entries();
  const float border = 2 * ImGui::GetStyle().WindowPadding.x + ImGui::GetStyle().ScrollbarSize;
  const float width = width_of(w, entries), gap = w.px(between_columns);
  const float count = std::clamp(std::floor((display.x - border + gap) / (width + gap)), 1.0f, 3.0f);
  const float content = count * (width + gap) - gap, needed = content + border;
  ImVec2 middle{0.5f * (area.min.x + area.max.x), 0.5f * display.y};
  if (area.max.x - area.min.x < needed) middle.x = 0.5f * display.x;
  ImGui::SetNextWindowPos(middle, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({0, 0}, {display.x, display.y - w.px(8)});  // a higher text scrolls
  ImGui::SetNextWindowBgAlpha(1.0f);  // the hash table's squares would make it hard to read
  bool open = true;
  ImGui::Begin("Help", &open,
               ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                   ImGuiWindowFlags_NoSavedSettings);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ImGui::GetStyle().ItemSpacing.x, w.px(3)});
  float left = ImGui::GetCursorPosX();
  ImGui::PushTextWrapPos(left + content);
  ImGui::TextUnformatted(
      "Soft spheres fall on a solid sphere. In every frame a method finds all pairs of vertices that are closer than "
      "the tolerance. With vertex-vertex contact, these pairs push the bodies apart, as in the paper. With surface "
      "contact, faces and edges do. The panel has all settings.");
  ImGui::PopTextWrapPos();
  ImGui::Spacing();
  const auto length = static_cast<std::size_t>(std::ceil(static_cast<float>(entries.size()) / count));
  for (std::size_t first = 0; first < entries.size(); first += length, left += width + gap) {
    if (first > 0) ImGui::SameLine();
    draw_entries(w, std::span(entries).subspan(first, std::min(length, entries.size() - first)), left);
  }
  ImGui::PopStyleVar();
  ImGui::Spacing();
  if (w.button("Close", "Closes the help (F1 or Esc).", w.px(80))) open = false;
  ImGui::End();
  if (!open) w.ask([](UiState& ui) { ui.help = false; });
}

}  // namespace app::ui
