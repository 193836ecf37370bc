#pragma once
// The list of all methods in their groups: which one drives the bodies, and which ones are shown side by side.

#include "app/session/session.h"
#include "app/ui/widgets/widgets.h"

namespace app::ui {

/// Draws the list as a combo with this label and preview. A click on a name lets the method drive. A check box shows or
/// hides a method, a group or all methods.
void draw_method_choice(Widgets& w, Session& session, const char* label, const char* preview, const char* tooltip);

/// The same, to choose what a view shows. The preview says how many methods are shown.
void draw_shown_methods(Widgets& w, Session& session);

}  // namespace app::ui
