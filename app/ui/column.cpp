#include "app/ui/column.h"

#include "app/ui/bucket_view.h"
#include "app/ui/status.h"
#include "app/ui/surface_view.h"

namespace app {

bool has_column(const Session& session, const UiState& ui) {
  return ui.table || session.bucket() || ui.overlays.true_surfaces || has_legend(session, ui.overlays);
}

void draw_column(Widgets& w, Session& session, UiState& ui, HashView& hash_view, const SceneArea& area) {
  const ImGuiStyle& style = ImGui::GetStyle();
  // The same width with and without a scrollbar.
  ImGui::SetNextWindowContentSize({w.px(column_width) - 2 * style.WindowPadding.x - style.ScrollbarSize, 0});
  begin_dock("Column", area, false);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {style.ItemSpacing.x, w.px(2)});
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {style.FramePadding.x, w.px(2)});
  if (ui.table) hash_view.draw(w, session, ui.table);
  if (session.bucket()) draw_bucket(w, session);
  const auto separate = [] {
    if (ImGui::GetCursorPosY() == ImGui::GetCursorStartPos().y) return;
    ImGui::Spacing();
    ImGui::Separator();
  };
  if (has_legend(session, ui.overlays)) {
    separate();
    ImGui::PushTextWrapPos(0);
    draw_legend(w, session, ui.overlays, !ui.table);
    ImGui::PopTextWrapPos();
  }
  if (ui.overlays.true_surfaces) {
    separate();
    draw_true_surfaces(w, session);
  }
  ImGui::PopStyleVar(2);
  end_dock();
}

}  // namespace app
