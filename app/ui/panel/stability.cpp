// The panel's section on stability: integrator, and the curves of energies, volumes, strain and speed.
// The status light of the step is here, too.

#include <algorithm>
#include <string_view>

#include <fmt/core.h>

#include "app/render/palette.h"
#include "app/ui/panel/panel.h"
#include "app/ui/views/status.h"

namespace app::ui {
namespace {

std::string step_text(const session::StepMargin& margin, const softbody::BodiesInMotion& world) {
  if (margin.taken == 0) return world.all_at_rest() ? "nothing moves" : "not measured yet";
  if (margin.share < 1) return fmt::format("{:.2g} % of each frame in {} substeps", 100 * margin.share, margin.taken);
  if (margin.kind == session::StepMargin::Bound::unconditional)
    return fmt::format("{:.2f} ms, stable at any length", margin.substep * 1e3);
  return fmt::format("{:.2f} ms, limit {:.2f} ms", margin.substep * 1e3, margin.bound * 1e3 / (1 - margin.reserve));
}

/// Draws two rows: the list of integrators, and the substeps if they are fixed. Returns true if the choice changed.
/// `proposed`: the substeps when the user begins to fix them.
bool draw_integrator_choice(Widgets& w, softbody::IntegratorChoice& choice, int proposed) {
  const softbody::IntegratorChoice before = choice;
  const softbody::Integrator& now = *softbody::find_integrator(choice.key);
  w.row_label("Integrator", w.px(label_column));
  if (w.begin_combo("Integrator", now.name, now.summary)) {
    for (const softbody::Integrator& i : softbody::integrators())
      if (w.combo_item(i.name, &i == &now, i.summary)) choice.key = i.key;
    ImGui::EndCombo();
  }
  const bool fixed = choice.substeps.has_value();
  if (w.checkbox("Fixed substeps", fixed,
                 "Takes a fixed number of steps per frame. If they are too few, explicit integrators blow up."))
    choice.substeps = fixed ? std::nullopt : std::optional(std::max(1, proposed));
  const Disabled off(!choice.substeps);
  w.row_label("Substeps", w.px(label_column));
  int substeps = choice.substeps.value_or(std::max(1, proposed));
  if (w.slider("Substeps", substeps, 1, std::max(100, substeps), "%d per frame",
               "Steps of the integrator in each frame. Fewer are faster but less stable."))
    choice.substeps = substeps;
  return choice != before;
}

/// Draws the choice of integrator and substeps, and the integrator in use if it is chosen automatically.
void draw_integrator(Widgets& w, const Session& session) {
  const softbody::World& world = *session.simulation.simulated(session.simulation.edits);
  const softbody::StepReport& last = world.last_step();
  softbody::IntegratorChoice choice = world.integrator_choice();
  const int needed = std::max(session.simulation.stability().margin().needed, last.substeps);
  const int proposed = std::min(needed, softbody::max_fixed_substeps);
  if (draw_integrator_choice(w, choice, proposed)) w.ask([choice](Session& s) { s.settings.set_integrator(choice); });
  const bool chosen = !last.integrator->automatic;  // not before the first step
  const std::string why = world.integrator_choice().integrator().automatic
                              ? "Chosen automatically: " + std::string(last.why) + "."
                              : "The integrator that you chose.";
  w.figure("Active integrator", chosen ? std::string(last.integrator->name) : "next step", why);
  const session::StepMargin& margin = session.simulation.stability().margin();
  w.figure("Substep", step_text(margin, world), status_light(margin).sentence);
}

constexpr glm::vec3 energy_colour{0.000f, 0.447f, 0.698f}, shape_colour{0.000f, 0.620f, 0.451f}, plain{0.45f};

}  // namespace

StatusLight status_light(const session::StepMargin& margin) {
  using Bound = session::StepMargin::Bound;
  if (margin.share < 1)
    return {render::status_amber, "Amber", "Slow motion",
            "A frame needs more work than is allowed, so only a part of it is simulated."};
  const bool within = margin.taken >= margin.needed;
  if (margin.kind == Bound::unconditional && !within)
    return {render::status_amber, "Amber", "Step long",
            "The step is stable, but too long for bodies this fast near solids, or for contacts this stiff."};
  if (margin.kind == Bound::by_damping && within && margin.taken > 0)
    return {render::status_amber, "Amber", "Step stable by damping",
            "Dampers keep the springs stable. Gas and contacts may still gain energy."};
  if (within) return {render::status_green, "Green", "Step stable", "The step is within the stability bound."};
  if (margin.taken >= (1 - margin.reserve) * margin.needed)
    return {render::status_amber, "Amber", "Step near the limit", "The step uses up the reserve."};
  return {render::status_red, "Red", "Step unstable", "The step exceeds the stability bound. Bodies may explode."};
}

void draw_step_light(Widgets& w, const Session& session) {
  const session::StepMargin& margin = session.simulation.stability().margin();
  if (const StatusLight light = status_light(margin); light.colour != render::status_green) {
    ImGui::BeginGroup();
    w.dot(light.colour);
    w.text_line(std::string(light.label).append(": ").append(step_text(margin, session.world())));
    ImGui::EndGroup();
    w.register_item("Step light", fmt::format("{} Substeps per frame: {} taken, {} needed.", light.sentence,
                                              margin.taken, margin.needed));
  }
  const auto& blow_up = session.simulation.stability().blow_up();
  if (!blow_up) return;
  w.wrapped_text("Blow-up",
                 fmt::format("{} (frame {}). Rewind, then choose more substeps, Auto, or softer springs.",
                             blow_up->what, blow_up->frame),
                 true);
  if (w.button("Rewind to the last good frame", "Goes back to the last frame before the blow-up."))
    w.ask([](Session& s) { s.simulation.rewind_to(s.simulation.stability().last_good_frame()); });
}

void draw_stability(Widgets& w, const Session& session, const UiState&) {
  draw_integrator(w, session);
  if (w.checkbox("Pause when a body explodes", session.simulation.pause_on_blow_up,
                 "Pauses in the first frame in which a body has more energy or speed than possible, and names it."))
    w.ask([](Session& s) { s.simulation.pause_on_blow_up = !s.simulation.pause_on_blow_up; });
  const session::StabilityHistory& history = session.simulation.stability().history();
  for (std::size_t i = 0; i < history.size(); ++i) {
    const session::StabilityQuantity& q = session::stability_quantities[i];
    const bool energy = std::string_view(q.unit) == "J";
    w.curve(q.name, fmt::format(q.format, history[i].latest()), history[i], axis_around(history[i], q.least),
            energy    ? energy_colour
            : *q.unit ? plain
                      : shape_colour,
            {q.meaning, q.unit});
  }
}

}  // namespace app::ui
