#pragma once
// Which integrator moves a world, with how many substeps; and the ghost, a second world moved by another.

#include "app/session/session.h"
#include "app/ui/widgets/widgets.h"

namespace app {

/// Two rows: an integrator from the list, and whether its substeps are fixed, and at how many. True if that changed.
/// name: of the whole, in labels ("" or "Ghost "); proposed: substeps to begin with.
bool draw_integrator_choice(Widgets& widgets, const char* name, softbody::IntegratorChoice& choice, int proposed);

/// The ghost's switch, its integrator, and how far it is from the world that is shown.
void draw_ghost(Widgets& widgets, Session& session);

/// What is opaque and what is translucent, for the legend.
void draw_ghost_legend(Widgets& widgets, const Session& session);

}  // namespace app
