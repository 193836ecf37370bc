#pragma once
// What is known of a world's stability while it runs: its past to go back to, a blow-up when it blows up, its step
// against the bound, and how its energies went.

#include "app/base/time_series.h"
#include "app/session/blow_up_monitor.h"
#include "app/session/rewind.h"

namespace app {

struct StabilityHistory {
  TimeSeries kinetic, elastic, gas, gravity, total;  // J; springs and gas against the starting shapes
  TimeSeries min_volume, max_volume;                 // over the starting one
  TimeSeries strain, speed;                          // the largest; m/s
};

/// Substeps of a frame: those that were taken, and those that the stability bound asks for. All 0 if nothing moves, or
/// no step was taken since the world went back.
struct StepMargin {
  /// What the bound means for the integrator at work.
  enum class Bound {
    stable,         // shorter steps than it are; a fifth of it is kept in reserve
    by_damping,     // they are where springs are all that swings: gas and contacts may still gain energy
    unconditional,  // all are: it only follows fast bodies near solids, and long frames
  };
  static constexpr double reserve = 0.2;

  int taken = 0, needed = 0;
  double substep = 0, bound = 0;  // s, the reserve taken off
  Bound kind = Bound::stable;
  double share = 1;  // of the frame: less where it would take more substeps than there may be
};

class StabilityMonitor {
 public:
  /// A larger world is measured every so many frames: one more for every so many vertices.
  static constexpr std::size_t vertices_a_frame = 50'000;

  /// Around each step of the world; `monitored`: raise a blow-up() if it blows up.
  void before_step(const softbody::World& world);
  void after_step(const softbody::World& world, bool monitored);
  /// The user has changed something: energy may have come with it.
  void intervened() { monitor_.restart(); }
  /// The user has read the blow_up() and goes on. There is no other before the world was good for a while.
  void dismiss_blow_up() { blow_up_.reset(); }
  /// Another world, of which nothing is known but what is so now.
  void restart(const softbody::World& world);
  /// The world has gone back to one of past(): what came later is forgotten, and what is so now is measured.
  void went_back(const softbody::World& world);
  /// Keeps the present, so that one can come back to it, unless it is an exploded one or belongs to the past.
  void keep_present(const softbody::World& world);

  const Rewind& past() const { return rewind_; }
  /// The last frame of past() that was found good: the first after a change, which may have exploded in it, never is,
  /// and none is while a hand holds a body.
  int last_good_frame() const { return rewind_.snapshots()[rewind_.at(good_frame_)].frame; }
  const std::optional<BlowUp>& blow_up() const { return blow_up_; }
  const StabilityHistory& history() const { return history_; }
  const StepMargin& margin() const { return margin_; }

 private:
  void record(const softbody::World& world, const std::vector<softbody::BodyMeasures>& bodies);
  void update_blow_up(const softbody::World& world, const std::vector<softbody::BodyMeasures>& bodies);

  Rewind rewind_;
  BlowUpMonitor monitor_;
  std::optional<BlowUp> blow_up_;
  std::size_t recovery_ = 0;  // looks, before the world counts as good again
  int good_frame_ = 0;
  StabilityHistory history_;
  StepMargin margin_;
  int needed_before_ = 0;  // substeps, at the end of the last step
};

}  // namespace app
