#include "app/panel/help.h"

#include "app/demo/shortcuts.h"

namespace app {
namespace {

constexpr float key_width = 78, half_width = 270;  // design pixels

/// A key and what it does; `left` is where the pair begins.
void entry(const Widgets& w, std::string_view key, std::string_view what, float left) {
  ImGui::SetCursorPosX(left);
  ImGui::TextUnformatted(key.data(), key.data() + key.size());
  ImGui::SameLine();
  ImGui::SetCursorPosX(left + w.px(key_width));
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextUnformatted(what.data(), what.data() + what.size());
  ImGui::PopStyleColor();
}

void keyboard(const Widgets& w, float left) {
  ImGui::BeginGroup();
  for (const Shortcut& shortcut : shortcuts()) entry(w, shortcut.label, shortcut.what, left);
  ImGui::EndGroup();
}

void overlays_and_mouse(const Widgets& w, float left) {
  ImGui::BeginGroup();
  for (const OverlayRow& row : overlay_table) entry(w, std::string_view(&row.shortcut, 1), row.label, left);
  ImGui::Dummy({0, ImGui::GetTextLineHeight()});
  for (const MouseUse& use : mouse_uses()) entry(w, use.label, use.what, left);
  ImGui::EndGroup();
}

}  // namespace

void draw_help(Widgets& w, const SceneArea& area, bool& open) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImVec2 middle{0.5f * (area.min.x + area.max.x), 0.5f * display.y};
  const bool narrow = display.x < w.px(2.2f * half_width);
  if (narrow || display.x - area.min.x < w.px(2.2f * half_width)) middle.x = 0.5f * display.x;
  ImGui::SetNextWindowPos(middle, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({0, 0}, {display.x, display.y - w.px(8)});  // it scrolls if it has to
  ImGui::SetNextWindowBgAlpha(1.0f);  // over the table's squares it would be hard to read otherwise
  ImGui::Begin("Help", &open,
               ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                   ImGuiWindowFlags_NoSavedSettings);
  ImGui::PushTextWrapPos(narrow ? w.px(half_width) : w.px(1.8f * half_width));
  ImGui::TextUnformatted(
      "Soft spheres fall on a solid sphere. In every frame a detector finds which of their vertices come closer than "
      "the tolerance. With vertex-vertex contact, the paper's, these push the bodies apart; with surface contact faces "
      "and edges do. Choose in the panel, and switch on what you want to see.");
  ImGui::PopTextWrapPos();
  ImGui::Spacing();
  const float left = ImGui::GetCursorPosX();
  keyboard(w, left);
  if (narrow)
    ImGui::Spacing();
  else
    ImGui::SameLine();
  overlays_and_mouse(w, narrow ? left : left + w.px(half_width));
  ImGui::Spacing();
  if (w.button("Close", "F1 or Esc closes it too.", w.px(80))) open = false;
  ImGui::End();
}

}  // namespace app
