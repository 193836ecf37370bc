// The panel's section on stability: integrator, ghost, and the curves of energies, volumes, strain and speed.
// The status light of the step is here, too.

#include <algorithm>
#include <array>

#include <fmt/core.h>

#include "app/render/palette.h"
#include "app/ui/panel/integrators.h"
#include "app/ui/panel/panel.h"
#include "app/ui/views/status.h"
#include "softbody/limits.h"

namespace app::ui {
namespace {

std::string step_text(const session::StepMargin& margin, const softbody::World& world) {
  if (margin.taken == 0)
    return world.all_at_rest() ? "nothing moves, so there is no step to judge" : "the next step will be judged";
  if (margin.share < 1) return fmt::format("slow motion: {:.2g} of a frame in {} substeps", margin.share, margin.taken);
  if (margin.kind == session::StepMargin::Bound::unconditional)
    return fmt::format("substeps of {:.2f} ms, stable at any length", margin.substep * 1e3);
  return fmt::format("substeps of {:.2f} ms, stable up to {:.2f} ms", margin.substep * 1e3,
                     margin.bound * 1e3 / (1 - session::StepMargin::reserve));
}

/// Draws the choice of integrator and substeps, and the integrator in use if it is chosen automatically.
void draw_integrator(Widgets& w, Session& session) {
  const softbody::World& world = session.world();
  const softbody::StepReport& last = world.last_step();
  softbody::IntegratorChoice choice = world.integrator_choice();
  const int needed = std::max(session.simulation.stability().margin().needed, last.substeps);
  const int proposed = std::min(needed, softbody::max_substeps);
  if (draw_integrator_choice(w, "", choice, proposed)) session.settings.set_integrator(choice);
  const bool chosen = !last.integrator->automatic;  // not before the first step
  const std::string why = world.integrator_choice().integrator().automatic ? "Because " + std::string(last.why) + "."
                                                                           : "The one that was chosen.";
  w.figure("At work", chosen ? std::string(last.integrator->name) : "from the next step on", why.c_str());
}

struct StabilityCurve {
  const char* label;
  TimeSeries session::StabilityHistory::*series;
  fmt::format_string<float> format;
  float least;  // the axis is at least so long
  const char* unit;
  glm::vec3 colour;
};
constexpr glm::vec3 energy_colour{0.000f, 0.447f, 0.698f}, shape_colour{0.000f, 0.620f, 0.451f}, plain{0.45f};
constexpr std::array<StabilityCurve, 9> curves{{
    {"Kinetic", &session::StabilityHistory::kinetic, "{:.3g} J", 1, "J of motion", energy_colour},
    {"Elastic", &session::StabilityHistory::elastic, "{:.3g} J", 1, "J in springs and kept shapes, against the start",
     energy_colour},
    {"Gas", &session::StabilityHistory::gas, "{:.3g} J", 1, "J in the gas and the air outside, against the start",
     energy_colour},
    {"Gravity", &session::StabilityHistory::gravity, "{:.4g} J", 1, "J above or below the world's origin",
     energy_colour},
    {"Total", &session::StabilityHistory::total, "{:.4g} J", 1, "J, but for what contacts store", energy_colour},
    {"Least volume", &session::StabilityHistory::min_volume, "{:.3f}", 0.1f, "of the volume at the start",
     shape_colour},
    {"Most volume", &session::StabilityHistory::max_volume, "{:.3f}", 0.1f, "of the volume at the start", shape_colour},
    {"Strain", &session::StabilityHistory::strain, "{:.3f}", 0.1f, "of a spring's resting length, the largest",
     shape_colour},
    {"Speed", &session::StabilityHistory::speed, "{:.2f} m/s", 1, "m/s of the fastest particle", plain},
}};

}  // namespace

StatusLight status_light(const session::StepMargin& margin) {
  using Bound = session::StepMargin::Bound;
  if (margin.share < 1)
    return {render::status_amber, "Amber",
            "a frame would take more substeps than there may be, so less of it is simulated."};
  const bool within = margin.taken >= margin.needed;
  if (margin.kind == Bound::unconditional && !within)
    return {render::status_amber, "Amber",
            "stable at any step, but bodies this fast near solids, or frames this long, want shorter ones."};
  if (margin.kind == Bound::by_damping && within && margin.taken > 0)
    return {render::status_amber, "Amber",
            "stable where dampers are strong enough: gas and contacts may still gain energy."};
  if (within) return {render::status_green, "Green", "the step is within the stability bound."};
  if (margin.taken >= (1 - session::StepMargin::reserve) * margin.needed)
    return {render::status_amber, "Amber", "the step uses up the bound's reserve of a fifth."};
  return {render::status_red, "Red", "the step is beyond the stability bound: expect the bodies to explode."};
}

void draw_step_light(Widgets& w, Session& session) {
  const session::StepMargin& margin = session.simulation.stability().margin();
  const StatusLight light = status_light(margin);
  ImGui::BeginGroup();
  w.dot(light.colour);
  w.text_line(std::string(light.name).append(": ").append(step_text(margin, session.world())));
  ImGui::EndGroup();
  w.register_item(
      "Step light",
      fmt::format("{}: {} Taken: {} substeps a frame; needed: {}{}.", light.name, light.sentence, margin.taken,
                  margin.needed,
                  margin.kind == session::StepMargin::Bound::unconditional ? "" : ", with a reserve of a fifth")
          .c_str());
  if (!session.simulation.stability().blow_up()) return;
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::ColorConvertU32ToFloat4(to_imgui(render::status_red)));
  ImGui::TextWrapped("%s (frame %d). Rewind, then take more substeps, Auto or softer springs.",
                     session.simulation.stability().blow_up()->what.c_str(),
                     session.simulation.stability().blow_up()->frame);
  ImGui::PopStyleColor();
  w.register_item("Alarm", nullptr);
  if (w.button("Rewind to the last good frame", "The world as it was before; then try other settings, or go on."))
    session.simulation.rewind_to(session.simulation.stability().last_good_frame());
}

void draw_stability(Widgets& w, Session& session) {
  draw_integrator(w, session);
  draw_ghost(w, session);
  w.checkbox("Pause when a body explodes", session.simulation.pause_on_blow_up,
             "Pauses in the first frame in which a body is no longer finite, or has more energy or speed than anything "
             "there could give it, and names it.");
  const session::StabilityHistory& history = session.simulation.stability().history();
  for (const StabilityCurve& c : curves) {
    const TimeSeries& series = history.*c.series;
    w.curve(c.label, fmt::format(c.format, series.latest()), series, axis_around(series, c.least), c.colour, c.unit);
  }
}

}  // namespace app::ui
