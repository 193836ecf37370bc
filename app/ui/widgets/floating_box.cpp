#include "app/ui/widgets/floating_box.h"

#include <algorithm>
#include <cmath>

namespace app::ui {

float box_width(const Widgets& w, const ScreenRect& area) {
  const float width = area.max.x - area.min.x, margin = w.px(box_margin),
              half = std::floor(0.5f * (width - 3 * margin));
  if (half >= w.px(min_box_width)) return std::min(half, w.px(max_box_width));
  return std::min(width - 2 * margin, w.px(max_box_width));
}

void FloatingBox::begin(Widgets& w, const char* name, const ScreenRect& area, float width, bool at_right) {
  const ImVec2 first{area.min.x + w.px(box_margin), area.min.y + w.px(box_margin)};
  const ImVec2 last{std::max(first.x, area.max.x - w.px(box_margin) - width),
                    std::max(first.y, area.max.y - w.px(box_margin) - (last_.max.y - last_.min.y))};
  const auto within = [&](const ImVec2& at) {
    return ImVec2(std::floor(std::clamp(at.x, first.x, last.x)), std::floor(std::clamp(at.y, first.y, last.y)));
  };
  const ImVec2 wanted = within(moved_to_  ? ImVec2(area.min.x + moved_to_->x, area.min.y + moved_to_->y)
                               : at_right ? ImVec2(last.x, first.y)
                                          : first);
  // The mouse cannot move a window whose place is set in every frame.
  if (wanted.x != last_.min.x || wanted.y != last_.min.y) ImGui::SetNextWindowPos(wanted);
  ImGui::SetNextWindowSize({width, 0});
  ImGui::Begin(name, nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                   ImGuiWindowFlags_NoNav | ImGuiWindowFlags_AlwaysAutoResize);
  w.keep_tooltips_off();
  const ImVec2 moved = ImGui::GetWindowPos(), at = within(moved);
  if (moved.x == wanted.x && moved.y == wanted.y) return;
  moved_to_ = ImVec2(at.x - area.min.x, at.y - area.min.y);
  ImGui::SetWindowPos(at);
}

float FloatingBox::end(const ScreenRect& area) {
  const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  last_ = {at, {at.x + size.x, at.y + size.y}};
  ImGui::End();
  return moved_to_ ? area.min.y : last_.max.y;
}

}  // namespace app::ui
