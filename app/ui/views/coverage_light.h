#pragma once
// The status light of coverage (red, amber or green) and its explanation.

#include "app/ui/views/status.h"

namespace app::ui {

/// What contacts of vertices do not tell of the surfaces; no text if there is nothing to tell.
struct SurfaceRemark {
  std::string text;
  bool penetrates = false;  // vertices are inside other bodies
};
/// Tells what the surface oracle found, if it runs; else whether vertices can slip through faces.
SurfaceRemark surface_remark(const Session& session);

/// Compares the largest box of the paper's method with the cell, axis by axis, and says what follows, in one or two
/// sentences.
std::string box_against_cell(const collide::DebugGeometry& paper, const glm::vec3& cell);

/// Draws the light with what the method finds, and a remark on the surfaces, if any. They act as a button. A click
/// asks for the meaning of all three colours, which stands below if `explained`.
void draw_coverage_light(Widgets& widgets, const Session& session, bool explained);

}  // namespace app::ui
