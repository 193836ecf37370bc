// The panel's section on stability: the way back, and how energies, volumes, strains and speeds went. Its light stands
// in the status.

#include <algorithm>
#include <array>

#include <fmt/core.h>

#include "app/render/palette.h"
#include "app/ui/panel/integrators.h"
#include "app/ui/panel/panel.h"
#include "app/ui/status.h"

namespace app {
namespace {

std::string in_numbers(const StepMargin& margin, const softbody::World& world) {
  if (margin.taken == 0)
    return world.all_at_rest() ? "nothing moves, so there is no step to judge" : "the next step will be judged";
  if (margin.share < 1) return fmt::format("slow motion: {:.2g} of a frame in {} substeps", margin.share, margin.taken);
  if (margin.kind == StepMargin::Bound::unconditional)
    return fmt::format("substeps of {:.2f} ms, stable at any length", margin.substep * 1e3);
  return fmt::format("substeps of {:.2f} ms, stable up to {:.2f} ms", margin.substep * 1e3,
                     margin.bound * 1e3 / (1 - StepMargin::reserve));
}

/// From the first snapshot to the newest; dragging goes there and pauses.
void draw_past(Widgets& w, Session& session) {
  const auto& past = session.stability().past().snapshots();
  const auto frame = session.world().frame();
  w.row("Go back to", w.px(label_column));
  ImGui::BeginDisabled(past.empty());
  int place = past.empty() ? 0 : static_cast<int>(session.stability().past().at(frame));
  const int last = past.empty() ? 0 : static_cast<int>(past.size()) - 1;
  const std::string shown = fmt::format("frame {}, {:.2f} s", frame, session.world().time());
  if (w.slider("Go back to", place, 0, last, shown.c_str(),
               "Drag through what has been; the world pauses there and goes on from there, to the bit as it did, with "
               "the settings in use. Snapshots are dense lately and sparse long ago."))
    session.rewind_to(past[static_cast<std::size_t>(place)].frame);
  ImGui::EndDisabled();
  const double mebi = static_cast<double>(session.stability().past().bytes()) / (1 << 20);
  w.figure("Snapshots", fmt::format("{}, {:.1f} of {} MiB", past.size(), mebi, Rewind::most_bytes >> 20),
           "Memory is bounded: when it is full, old snapshots are thinned out.");
}

/// Which integrator, with how many substeps; and which one is at work, if it chooses by itself.
void draw_integrator(Widgets& w, Session& session) {
  const softbody::World& world = session.world();
  IntegratorChoice choice{std::string(world.integrator().key), world.substeps()};
  const int asked = std::max(session.stability().margin().needed, world.profile().substeps);
  const int proposed = std::min(asked, softbody::World::max_substeps);
  if (draw_integrator_choice(w, "", choice, proposed)) session.set_integrator(choice.key, choice.substeps);
  const softbody::Dynamics& dynamics = world.dynamics();
  const bool chosen = !dynamics.used_integrator().automatic;  // not before the first step
  const std::string why = world.integrator().automatic ? "Because " + std::string(dynamics.why_integrator()) + "."
                                                       : "The one that was chosen.";
  w.figure("At work", chosen ? std::string(dynamics.used_integrator().name) : "from the next step on", why.c_str());
}

struct StabilityCurve {
  const char* label;
  Ring StabilityHistory::*ring;
  fmt::format_string<float> format;
  float least;  // length of the axis
  const char* unit;
  glm::vec3 colour;
};
constexpr glm::vec3 energy_colour{0.000f, 0.447f, 0.698f}, shape_colour{0.000f, 0.620f, 0.451f}, plain{0.45f};
constexpr std::array<StabilityCurve, 9> curves{{
    {"Kinetic", &StabilityHistory::kinetic, "{:.3g} J", 1, "J of motion", energy_colour},
    {"Elastic", &StabilityHistory::elastic, "{:.3g} J", 1, "J in springs and kept shapes, against the start",
     energy_colour},
    {"Gas", &StabilityHistory::gas, "{:.3g} J", 1, "J in the gas and the air outside, against the start",
     energy_colour},
    {"Gravity", &StabilityHistory::gravity, "{:.4g} J", 1, "J above or below the world's origin", energy_colour},
    {"Total", &StabilityHistory::total, "{:.4g} J", 1, "J, but for what contacts store", energy_colour},
    {"Least volume", &StabilityHistory::least_volume, "{:.3f}", 0.1f, "of the volume at the start", shape_colour},
    {"Most volume", &StabilityHistory::most_volume, "{:.3f}", 0.1f, "of the volume at the start", shape_colour},
    {"Strain", &StabilityHistory::strain, "{:.3f}", 0.1f, "of a spring's resting length, the largest", shape_colour},
    {"Speed", &StabilityHistory::speed, "{:.2f} m/s", 1, "m/s of the fastest particle", plain},
}};

}  // namespace

Light light_of(const StepMargin& margin) {
  using Bound = StepMargin::Bound;
  if (margin.share < 1)
    return {light_amber, "Amber", "a frame would take more substeps than there may be, so less of it is simulated."};
  const bool within = margin.taken >= margin.needed;
  if (margin.kind == Bound::unconditional && !within)
    return {light_amber, "Amber",
            "stable at any step, but bodies this fast near solids, or frames this long, want shorter ones."};
  if (margin.kind == Bound::by_damping && within && margin.taken > 0)
    return {light_amber, "Amber", "stable where dampers are strong enough: gas and contacts may still gain energy."};
  if (within) return {light_green, "Green", "the step is within the stability bound."};
  if (margin.taken >= (1 - StepMargin::reserve) * margin.needed)
    return {light_amber, "Amber", "the step uses up the bound's reserve of a fifth."};
  return {light_red, "Red", "the step is beyond the stability bound: expect the bodies to explode."};
}

void draw_step_light(Widgets& w, Session& session) {
  const StepMargin& margin = session.stability().margin();
  const Light light = light_of(margin);
  ImGui::BeginGroup();
  w.dot(light.colour);
  w.line(std::string(light.name).append(": ").append(in_numbers(margin, session.world())));
  ImGui::EndGroup();
  w.done("Step light", fmt::format("{}: {} Taken: {} substeps a frame; needed: {}{}.", light.name, light.sentence,
                                   margin.taken, margin.needed,
                                   margin.kind == StepMargin::Bound::unconditional ? "" : ", with a reserve of a fifth")
                           .c_str());
  if (!session.stability().alarm()) return;
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::ColorConvertU32ToFloat4(to_imgui(light_red)));
  ImGui::TextWrapped("%s (frame %d). Rewind, then take more substeps, Auto or softer springs.",
                     session.stability().alarm()->what.c_str(), session.stability().alarm()->frame);
  ImGui::PopStyleColor();
  w.done("Alarm", nullptr);
  if (w.button("Rewind to the last good frame", "The world as it was before; then try other settings, or go on."))
    session.rewind_to(session.stability().last_good_frame());
}

void draw_stability(Widgets& w, Session& session) {
  draw_integrator(w, session);
  draw_ghost(w, session);
  w.checkbox("Pause when a body explodes", session.guarded,
             "Pauses in the first frame in which a body is no longer finite, or has more energy or speed than anything "
             "there could give it, and names it.");
  draw_past(w, session);
  const StabilityHistory& history = session.stability().history();
  for (const StabilityCurve& c : curves) {
    const Ring& ring = history.*c.ring;
    w.curve(c.label, fmt::format(c.format, ring.latest()), ring, axis_around(ring, c.least), c.colour, c.unit);
  }
}

}  // namespace app
