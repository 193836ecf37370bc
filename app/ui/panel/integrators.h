#pragma once
// The choice of integrator and substeps; and the ghost, a second world moved by another integrator.

#include "app/session/session.h"
#include "app/ui/widgets/widgets.h"

namespace app::ui {

/// Draws two rows: the list of integrators, and the substeps if they are fixed. Returns true if the choice changed.
/// `name` begins the widgets' labels ("" or "Ghost "). `proposed`: the substeps when the user begins to fix them.
bool draw_integrator_choice(Widgets& widgets, const char* name, softbody::IntegratorChoice& choice, int proposed);

/// Draws the ghost's switch, its integrator, and its distance from the world that is shown.
void draw_ghost(Widgets& widgets, Session& session);

}  // namespace app::ui
