#include "app/ui/widgets/floating_box.h"

#include <algorithm>
#include <cmath>

namespace app::ui {
namespace {

constexpr float margin = 12;  // to the ends of the area, design pixels

}  // namespace

void FloatingBox::begin(Widgets& w, const char* name, const ScreenRect& area, float width, bool at_right,
                        bool at_bottom) {
  const auto place = [&](float min, float max, float length, bool at_end, std::optional<float> moved_to) {
    const float first = min + w.px(margin), last = std::max(first, max - w.px(margin) - length);
    return std::floor(moved_to ? std::clamp(min + *moved_to, first, last) : at_end ? last : first);
  };
  const auto moved = [&](float ImVec2::*axis) { return moved_to_ ? std::optional(*moved_to_.*axis) : std::nullopt; };
  const ImVec2 wanted{place(area.min.x, area.max.x, width, at_right, moved(&ImVec2::x)),
                      place(area.min.y, area.max.y, last_.max.y - last_.min.y, at_bottom, moved(&ImVec2::y))};
  // The mouse cannot move a window whose place is set in every frame.
  if (wanted.x != last_.min.x || wanted.y != last_.min.y) ImGui::SetNextWindowPos(wanted);
  ImGui::SetNextWindowSize({width, 0});
  ImGui::Begin(name, nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                   ImGuiWindowFlags_NoNav | ImGuiWindowFlags_AlwaysAutoResize);
  w.keep_tooltips_off();
  const ImVec2 at = ImGui::GetWindowPos();
  if (at.x != wanted.x || at.y != wanted.y) moved_to_ = ImVec2(at.x - area.min.x, at.y - area.min.y);
}

ScreenRect FloatingBox::end() {
  const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  last_ = {at, {at.x + size.x, at.y + size.y}};
  ImGui::End();
  return last_;
}

}  // namespace app::ui
