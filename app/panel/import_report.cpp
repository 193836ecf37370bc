#include "app/panel/import_report.h"

#include <algorithm>

#include "app/view/palette.h"

namespace app {

void draw_import_report(Widgets& w, Import& import, const SceneArea& area) {
  if (import.report().empty()) return;
  const float margin = w.px(12), width = std::min(w.px(360), area.max.x - area.min.x - 2 * margin);
  ImGui::SetNextWindowPos({area.min.x + margin, area.max.y - margin}, ImGuiCond_Always, {0, 1});
  ImGui::SetNextWindowSize({width, 0});
  ImGui::Begin("Import", nullptr, plate);
  if (import.failed()) ImGui::PushStyleColor(ImGuiCol_Text, to_imgui(light_red));
  for (const std::string& line : import.report()) {
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(line.c_str());
    ImGui::PopTextWrapPos();
    w.done("Import report", nullptr);
  }
  if (import.failed()) ImGui::PopStyleColor();
  if (w.button("Close###Close import report", "It stands here until it is closed, or the next file is read.", w.px(80)))
    import.dismiss_report();
  ImGui::End();
}

}  // namespace app
