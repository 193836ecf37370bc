#include "app/ui/widgets/dock.h"

namespace app::ui {

ImVec4 dock_colour() { return ImGui::GetStyleColorVec4(ImGuiCol_MenuBarBg); }

void begin_dock(const char* name, const ScreenRect& area, bool opaque, ImGuiWindowFlags flags) {
  constexpr ImGuiWindowFlags fixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                     ImGuiWindowFlags_NoFocusOnAppearing;
  ImGui::SetNextWindowPos(area.min);
  ImGui::SetNextWindowSize({area.max.x - area.min.x, area.max.y - area.min.y});
  ImVec4 ground = dock_colour();
  ground.w = opaque ? 1.0f : 0.0f;
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ground);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
  ImGui::Begin(name, nullptr, fixed | flags);
  ImGui::PopStyleVar(2);
  ImGui::PopStyleColor();
}

}  // namespace app::ui
