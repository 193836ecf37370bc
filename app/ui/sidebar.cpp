#include "app/ui/parts.h"

#include "app/ui/views/views.h"

namespace app::ui {

bool has_sidebar(const Session& session, const UiState& ui) {
  return ui.hash_table || session.inspector.bucket() || ui.overlays.true_surfaces;
}

void draw_sidebar(Widgets& w, const Session& session, const UiState& ui, const ScreenRect& area) {
  const ImGuiStyle& style = ImGui::GetStyle();
  // The contents keep their width when a scrollbar appears.
  ImGui::SetNextWindowContentSize({w.px(sidebar_width) - 2 * style.WindowPadding.x - style.ScrollbarSize, 0});
  begin_dock("Sidebar", area, false);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {style.ItemSpacing.x, w.px(2)});
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {style.FramePadding.x, w.px(2)});
  if (ui.hash_table) draw_hash_table(w, session);
  if (session.inspector.bucket()) draw_bucket(w, session);
  const auto separate = [] {
    if (ImGui::GetCursorPosY() == ImGui::GetCursorStartPos().y) return;
    ImGui::Spacing();
    ImGui::Separator();
  };
  if (const render::Overlays shown = ui.drawn_overlays(session); has_legend(session, shown)) {
    separate();
    draw_legend(w, session, shown, !ui.hash_table, false);
  }
  if (ui.overlays.true_surfaces) {
    separate();
    draw_true_surfaces(w, session);
  }
  ImGui::PopStyleVar(2);
  ImGui::End();
}

}  // namespace app::ui
