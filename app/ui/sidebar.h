#pragma once
// The sidebar at the right of the scene: the hash table, the selected bucket, the legend of the overlays and the
// figures of the surface oracle, one below the other. It covers nothing of the scene.

#include "app/ui/panel/ui_state.h"
#include "app/ui/views/hash_table_view.h"
#include "app/ui/widgets/dock.h"

namespace app::ui {

inline constexpr float sidebar_width = 276;  // design pixels

/// True if the sidebar has anything to show.
bool has_sidebar(const Session& session, const UiState& ui);

/// Draws the sidebar over `area`.
void draw_sidebar(Widgets& widgets, Session& session, UiState& ui, HashTableView& hash_table_view,
                  const ScreenRect& area);

}  // namespace app::ui
