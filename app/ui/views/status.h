#pragma once
// What the strip above the scene shows even if the panel is hidden: the status lights with the live recall, and the
// legend of the overlays.

#include "app/render/overlays.h"
#include "app/session/session.h"
#include "app/ui/state/ui_state.h"
#include "app/ui/widgets/dock.h"

namespace app::ui {

struct StatusLight {
  glm::vec3 colour;
  const char* name;      // the colour in words
  const char* label;     // what the colour means, in one to three words
  const char* sentence;  // what the colour means
};
/// Returns the light of a method that can or cannot miss contacts, before any frame is known.
StatusLight status_light(const collide::Method& method);
StatusLight status_light(collide::Coverage coverage);
/// Returns green if the step keeps within the stability bound and its reserve, amber if it is within the bound, red if
/// it is beyond the bound.
StatusLight status_light(const session::StepMargin& margin);
/// Draws the status light of the step with its numbers. Below it stand the blow-up, if there is one, and the button
/// that rewinds.
void draw_step_light(Widgets& widgets, const Session& session);

/// Names the method whose boxes and buckets are shown: "Grid Hash, driving", or "Multi-Level SB, for comparison" if the
/// driving method has no table.
std::string shown_method_text(const Session& session);

/// Returns "misses 3 of 12", "finds all 12" and the like, or why that is not known.
std::string verdict(const session::LiveComparison& comparison, std::size_t method);
/// Rounds down to four digits, so that one missed contact of a million is not shown as a recall of 1.
double rounded_down(double share);
/// Returns "Measured against ...", with the reason if that is not brute force.
std::string reference_sentence(const compare::CompareReport& report);

/// Draws the two lights and the recall. `explained`: the meaning of all three colours is shown.
void draw_status(Widgets& widgets, const Session& session, bool explained);
/// True if an overlay that is shown needs a legend.
bool has_legend(const Session& session, const render::Overlays& shown);
/// Draws the legend of the overlays, if any. `names_method`: it also names the method whose boxes and cells are shown.
/// `flows`: several entries stand in a line.
void draw_legend(Widgets& widgets, const Session& session, const render::Overlays& shown, bool names_method,
                 bool flows);

}  // namespace app::ui
