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
                 "So many steps of the integrator a frame, whatever becomes of it: too few, and an explicit one blows "
                 "up. Else as many as the stability bound asks for."))
    choice.substeps = fixed ? std::optional(std::max(1, proposed)) : std::nullopt;
  ImGui::BeginDisabled(!fixed);
  w.row_label("Substeps", w.px(label_column));
  int substeps = choice.substeps.value_or(std::max(1, proposed));
  if (w.slider(fmt::format("{}Substeps", name).c_str(), substeps, 1, std::max(100, substeps), "%d a frame",
               "Fewer are faster, until it explodes."))
    choice.substeps = substeps;
  ImGui::EndDisabled();
  return choice != before;
}

void draw_ghost(Widgets& w, Session& session) {
  bool on = session.ghost().get() != nullptr;
  if (w.checkbox("Ghost world", on,
                 "The same bodies from this moment on, moved by another integrator: translucent, in a colour of their "
                 "own. Whenever hands or settings change the world, the ghost begins anew from it."))
    session.choose_ghost(on ? std::optional(softbody::IntegratorChoice{"velocity-verlet", {}}) : std::nullopt);
  if (!session.ghost().get()) return;
  softbody::IntegratorChoice choice = session.ghost().get()->choice();
  const int used = session.ghost().get()->world().last_step().substeps;
  if (draw_integrator_choice(w, "Ghost ", choice, used)) session.choose_ghost(choice);
  if (!session.ghost().get()) return;
  w.curve("Ghost apart", ghost_distance_text(session), session.ghost().distances(),
          {0, axis_end(session.ghost().distances().max(), 0.01f)}, render::ghost_colour,
          "radii: the root mean square distance of all vertices to the ghost's, each over its body's radius");
}

}  // namespace app::ui
