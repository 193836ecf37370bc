#pragma once
// What stands over the scene whether or not the panel is open: the light of coverage with the live recall, legends of
// the overlays, the caption of the moment, and hints for newcomers.

#include "app/render/overlays.h"
#include "app/session/session.h"
#include "app/ui/widgets/dock.h"

namespace app {

/// Of what stands over the scene without a frame to drag it by.
inline constexpr ImGuiWindowFlags plate = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                          ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                                          ImGuiWindowFlags_NoNav;

struct Light {
  glm::vec3 colour;
  const char* name;      // the colour in words
  const char* sentence;  // what it means
};
Light light_of(collide::Coverage coverage);
/// Green: the step keeps within the bound and its reserve. Amber: within the limit of stability. Red: beyond it.
Light light_of(const StepMargin& margin);
/// The step's light with its numbers; below it the blow-up, if there is one, and the way back.
void draw_step_light(Widgets& widgets, Session& session);

/// "of the driving method", or whose boxes and buckets are shown instead because the driving method has no table.
std::string whose_structure(const Session& session);

/// To four digits: one missed contact of a million is not a recall of 1.
double rounded_down(double share);
/// "Measured against ...", with the reason if that is not brute force.
std::string reference_sentence(const CompareReport& report);

/// The light, its sentence and the recall; below it Layout::no_room and the session's notice(), if any. Returns where
/// it ends. `explained`: with what the light's colours mean.
float draw_status(Widgets& widgets, Session& session, const std::string& no_room, const SceneArea& area,
                  bool& explained);
/// What the colours of the overlays mean; has_legend(): whether any that is shown needs it. `of_which_method`: also
/// whose boxes and cells are shown.
bool has_legend(const Session& session, const Overlays& shown);
void draw_legend(Widgets& widgets, const Session& session, const Overlays& shown, bool of_which_method);
/// The same, if any, over the scene in the upper left corner of the area.
void draw_legend_plate(Widgets& widgets, const Session& session, const Overlays& shown, const SceneArea& area);
/// Returns where it begins. `seconds`: how long the window has been open; the hint fades out after a while.
float draw_caption(Widgets& widgets, const Session& session, const SceneArea& area, double seconds);

}  // namespace app
