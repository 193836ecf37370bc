#pragma once
// The red, amber or green light of coverage, explained where it stands.

#include "app/ui/status.h"

namespace app {

/// The largest box of the paper's method against the cell, axis by axis, and what follows: in one or two sentences.
std::string box_against_cell(const collide::DebugGeometry& paper, const glm::vec3& cell);

/// The light and its sentence, a button; `explained`: what the three colours mean stands below it.
void draw_light(Widgets& widgets, const Session& session, bool& explained);

}  // namespace app
