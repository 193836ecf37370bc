#pragma once
// The status light of coverage (red, amber or green) and its explanation.

#include "app/ui/views/status.h"

namespace app::ui {

/// Compares the largest box of the paper's method with the cell, axis by axis, and says what follows, in one or two
/// sentences.
std::string box_against_cell(const collide::DebugGeometry& paper, const glm::vec3& cell);

/// Draws the light and its sentence, which act as a button. A click toggles `explained`: then the meaning of all three
/// colours stands below.
void draw_coverage_light(Widgets& widgets, const Session& session, bool& explained);

}  // namespace app::ui
