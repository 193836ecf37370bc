#pragma once
// The column at the right of the scene: the hash table and what is in a bucket, what the overlays' colours mean, and
// the surface oracle's figures. Below one another, so that nothing covers the scene.

#include "app/ui/hash_view.h"
#include "app/ui/ui_state.h"
#include "app/ui/widgets/dock.h"

namespace app {

inline constexpr float column_width = 276;  // design pixels

/// Whether there is anything to stand in it.
bool has_column(const Session& session, const UiState& ui);

void draw_column(Widgets& widgets, Session& session, UiState& ui, HashView& hash_view, const SceneArea& area);

}  // namespace app
