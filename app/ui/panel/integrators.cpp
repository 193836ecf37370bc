#include "app/ui/panel/integrators.h"

#include <algorithm>

#include <fmt/core.h>

#include "app/render/palette.h"
#include "app/ui/views/status.h"

namespace app::ui {
bool draw_integrator_choice(Widgets& w, const char* name, softbody::IntegratorChoice& choice, int proposed) {
  const softbody::IntegratorChoice before = choice;
  const softbody::Integrator& now = *softbody::find_integrator(choice.key);
  w.row_label("Integrator", w.px(label_column));
  if (w.begin_combo(fmt::format("{}Integrator", name).c_str(), std::string(now.name).c_str(),
                    std::string(now.summary).c_str())) {
    for (const softbody::Integrator& i : softbody::integrators())
      if (w.combo_item(std::string(i.name).c_str(), &i == &now, std::string(i.summary).c_str())) choice.key = i.key;
    ImGui::EndCombo();
  }
  bool fixed = choice.substeps.has_value();
  if (w.checkbox(fmt::format("Fixed substeps###{}Fixed substeps", name).c_str(), fixed,
                 "Takes a fixed number of steps per frame. If they are too few, explicit integrators blow up."))
    choice.substeps = fixed ? std::optional(std::max(1, proposed)) : std::nullopt;
  ImGui::BeginDisabled(!fixed);
  w.row_label("Substeps", w.px(label_column));
  int substeps = choice.substeps.value_or(std::max(1, proposed));
  if (w.slider(fmt::format("{}Substeps", name).c_str(), substeps, 1, std::max(100, substeps), "%d per frame",
               "Steps of the integrator in each frame. Fewer are faster but less stable."))
    choice.substeps = substeps;
  ImGui::EndDisabled();
  return choice != before;
}

void draw_ghost(Widgets& w, Session& session) {
  bool on = session.ghost().get() != nullptr;
  if (w.checkbox("Ghost world", on,
                 "Simulates the same bodies with another integrator, and draws them translucent. A change of the world "
                 "restarts the ghost."))
    session.choose_ghost(on ? std::optional(softbody::IntegratorChoice{"velocity-verlet", {}}) : std::nullopt);
  if (!session.ghost().get()) return;
  softbody::IntegratorChoice choice = session.ghost().get()->choice();
  const int used = session.ghost().get()->world().last_step().substeps;
  if (draw_integrator_choice(w, "Ghost ", choice, used)) session.choose_ghost(choice);
  if (!session.ghost().get()) return;
  w.curve("Ghost distance", ghost_distance_text(session), session.ghost().distances(),
          {0, axis_end(session.ghost().distances().max(), 0.01f)}, render::ghost_colour,
          {"Root mean square distance between the vertices of the two worlds, over the radius of the body.", "radii"});
}

}  // namespace app::ui
