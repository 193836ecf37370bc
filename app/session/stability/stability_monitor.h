#pragma once
// Monitors the stability of a simulated world: keeps its past, reports a blow-up, compares its step with the stability
// bound, and records its energies.

#include <algorithm>
#include <array>

#include <fmt/core.h>

#include "app/base/time_series.h"
#include "app/compare/blow_up_monitor.h"
#include "app/session/stability/rewind.h"
#include "softbody/model/body_model.h"
#include "softbody/world/measures.h"

namespace app::session {

/// A quantity that is recorded of a world, and how it is shown.
struct StabilityQuantity {
  const char *name, *column;  // on the panel; in the file of curves
  double (*of)(const softbody::Measures& now, const softbody::StoredEnergy& start);  // start: of the starting shapes
  fmt::format_string<float> format;
  float least;  // its axis is at least so long
  const char *meaning, *unit;
};
inline constexpr std::array<StabilityQuantity, 9> stability_quantities{{
    {"Kinetic", "kinetic_J", [](const auto& now, const auto&) { return now.energies.kinetic; }, "{:.3g} J", 1,
     "Energy of motion.", "J"},
    {"Elastic", "elastic_J", [](const auto& now, const auto& start) { return now.energies.elastic - start.elastic; },
     "{:.3g} J", 1, "Energy in springs and kept shapes, compared with the start.", "J"},
    {"Gas", "gas_J", [](const auto& now, const auto& start) { return now.energies.gas - start.gas; }, "{:.3g} J", 1,
     "Energy in the gas and the air outside, compared with the start.", "J"},
    {"Gravity", "gravity_J", [](const auto& now, const auto&) { return now.energies.gravity; }, "{:.4g} J", 1,
     "Potential energy, compared with the origin of the world.", "J"},
    {"Total", "total_J", [](const auto& now, const auto& start) { return now.energy - start.total(); }, "{:.4g} J", 1,
     "Sum of these energies, without that of contacts.", "J"},
    {"Smallest volume", "smallest_volume", [](const auto& now, const auto&) { return now.volume_ratio_min; }, "{:.3f}",
     0.1f, "Smallest volume of a body over its volume at the start.", ""},
    {"Largest volume", "largest_volume", [](const auto& now, const auto&) { return now.volume_ratio_max; }, "{:.3f}",
     0.1f, "Largest volume of a body over its volume at the start.", ""},
    {"Strain", "strain", [](const auto& now, const auto&) { return now.largest_strain; }, "{:.3f}", 0.1f,
     "Largest strain of a spring.", ""},
    {"Speed", "speed_m_s", [](const auto& now, const auto&) { return now.max_speed; }, "{:.2f} m/s", 1,
     "Speed of the fastest particle.", "m/s"},
}};
using StabilityHistory = std::array<TimeSeries, stability_quantities.size()>;  // by quantity

/// The substeps of the last frame beside those that the step controller's bound required. All are 0 if nothing moves,
/// or if no step was taken since the world went back.
struct StepMargin {
  /// What the bound means for the integrator in use.
  enum class Bound {
    stable,         // shorter steps are stable
    by_damping,     // shorter steps are stable if only springs swing: gas and contacts may still gain energy
    unconditional,  // springs and gas need no bound; fast bodies near solids, long frames and contact in XPBD do
  };
  int taken = 0, needed = 0;
  double substep = 0, bound = 0;  // s; bound: less the reserve
  double reserve = 0;             // share of the longest stable step
  Bound kind = Bound::stable;
  double share = 1;  // simulated share of the frame; below 1 if the whole frame would exceed the budget of work
};

class StabilityMonitor {
 public:
  /// A world is measured, and kept as a snapshot, once every 1 + vertices / vertices_a_frame frames, but every so many
  /// at least: so both take a small share of a frame, and a blow-up is named within ten frames.
  static constexpr std::size_t vertices_a_frame = 10'000, most_frames = 8;
  /// So many checks without a blow-up have to follow one before another is reported.
  static constexpr std::size_t recovery = 60;

  /// Returns true if the world is to be measured and kept in its present frame.
  static bool looks_at(const softbody::World& world) {
    return std::size_t(world.frame()) % std::min(most_frames, 1 + world.bodies().vertex_count() / vertices_a_frame) ==
           0;
  }
  /// Call these around each step of the world. monitored: report a blow_up(). before_step() returns true if it has kept
  /// the world in past().
  bool before_step(const softbody::World& world);
  void after_step(const softbody::World& world, bool monitored);
  /// Removes the blow_up() once the user continues. Another one is reported only after the world was good for a while.
  void dismiss_blow_up() { blow_up_.reset(); }
  /// Starts anew with another world.
  void restart(const softbody::World& world);
  /// Call this after the world has gone back to a snapshot of past(). Forgets what came later, and measures the world.
  void went_back(const softbody::World& world);
  /// Keeps the present as a snapshot, unless it has blown up or is already in past(). Returns true if it has.
  bool keep_present(const softbody::World& world);

  const Rewind& past() const { return rewind_; }
  /// Returns the last frame of past() that was found good. Precondition: past() is not empty.
  int last_good_frame() const { return rewind_.snapshots()[rewind_.at(good_frame_)].frame; }
  const std::optional<compare::BlowUp>& blow_up() const { return blow_up_; }
  const StabilityHistory& history() const { return history_; }
  const StepMargin& margin() const { return margin_; }

 private:
  void record(const softbody::World& world, const std::vector<softbody::BodyMeasures>& bodies);

  Rewind rewind_;
  compare::BlowUpMonitor blow_up_monitor_;
  std::optional<compare::BlowUp> blow_up_;
  std::size_t recovery_checks_ = 0;  // left before the world counts as good again
  int good_frame_ = 0;
  StabilityHistory history_;
  StepMargin margin_;
};

}  // namespace app::session
