#pragma once
// Decides which integrator moves the bodies in a frame, and in how many substeps. It sees no bodies, only numbers that
// say how they are. A user fixes a number of steps; one step is one substep, but for integrators that divide each step
// (Integrator::substeps_per_step).

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "softbody/integrate/integrators.h"
#include "softbody/integrate/work.h"

namespace softbody {

/// What bodies ask of their steps as they are now: the lowest rates (1/s) at which steps ...
struct StepBound {
  double stable = 0;           // ... are stable, but for breathing, of explicit integrators; 0 if all are
  double breathing = 0;        // ... are stable, if gas resists changes of the volume explicitly
  double deformation = 0;      // ... keep up with the body that changes its shape fastest
  double passing = 0;          // ... keep up with the fastest body near a solid, and with surfaces that pass each other
  double fastest = 0;          // and how many times its radius the fastest body goes in a second
  double volume_change = 0;    // and the largest share by which the volume of a body differs from the start's
  bool surfaces_near = false;  // some may touch each other before the bound is measured again
};

/// Returns the lowest rate (1/s) at which the integrator's steps are stable.
inline double stable_rate(const StepBound& bound, const Integrator& integrator) {
  if (integrator.implicit) return 0;
  return integrator.implicit_volume ? bound.stable : std::max(bound.stable, bound.breathing);
}

/// What else a frame depends on.
struct FrameConditions {
  double seconds = 0;
  std::size_t particles = 0, moving = 0;  // of all bodies, and of those that move
  std::size_t penalty_pairs = 0;
  bool near_solids = false, surface_contact = false;
  bool surfaces_touch = false;  // each other, or perhaps a solid's edges
  bool too_large = false;       // a body has too many particles for implicit steps
  double rounding = 0;          // m, of positions
  double sleep_speed = 0;       // m/s, below which bodies fall asleep
};

struct StepPlan {
  const Integrator* integrator = nullptr;
  std::string_view why;  // reason for the integrator; empty unless the controller chose it
  double substeps = 0;   // whole, into which what is left of the frame is to be divided; no int may hold it
  int needed = 0;        // that the bound alone asks of a whole frame, at most 5e8
};

/// The largest value, at least 0, of the last half second to one second.
class RecentMaximum {
 public:
  void advance(double seconds) {
    age_ += seconds;
    if (age_ < half_second) return;
    before_ = now_;
    now_ = age_ = 0;
  }
  void raise(double value) { now_ = std::max(now_, value); }
  double value() const { return std::max(now_, before_); }

 private:
  static constexpr double half_second = 0.5;
  double now_ = 0, before_ = 0;  // the largest in the half second that runs, and in the one before
  double age_ = 0;               // s, of the one that runs
};

class StepController {
 public:
  /// What the next frames depend on. The rates (1/s) are lower bounds of the substep rate of explicit integrators: of
  /// those that are implicit in the volume, and of others. Steps of equal length keep the energy of an oscillation
  /// bounded. Steps that get longer and shorter with the oscillation feed it, however short they are (Skeel and Gear
  /// 1992, "Does variable step size ruin a symplectic integrator?").
  struct Hysteresis {
    RecentMaximum implicit_volume_rate, explicit_rate, volume_change;
  };

  /// Takes the integrator, or `auto`, and the number of its steps in a frame if that is fixed.
  void set_choice(const IntegratorChoice& choice);
  void set_budget(const WorkBudget& budget) { budget_ = budget; }

  /// Begins a frame, and chooses its integrator if that is left to the controller. bound: at the
  /// frame's start, measured for bounds_of().
  void begin_frame(const FrameConditions& conditions, const StepBound& bound);
  /// Plans into how many substeps the last `left` seconds of the frame are divided, for this bound. Unless the number
  /// is fixed it is on a ladder, so that substeps have few lengths, see Integrator::step_lengths.
  const StepPlan& plan(const StepBound& bound, double left);
  /// Returns the last plan. Before the first one of a frame it has its integrator only.
  const StepPlan& plan() const { return plan_; }

  /// Returns the integrator for which bounds are to be measured: the choice, which may be `auto`.
  const Integrator& bounds_of() const { return *chosen_; }
  /// True if the controller chooses the integrator of each frame.
  bool automatic() const { return chosen_->automatic; }
  /// True if the number of steps is fixed. Then no budget counts.
  bool fixed() const { return fixed_steps_ > 0; }

  /// Adds to the work of this frame.
  void spend(double work) { spent_ += work; }
  double spent() const { return spent_; }
  /// Returns the work of an explicit substep without contact of surfaces.
  double work_of_substep() const { return work_of_substep_; }
  /// Returns the work of measuring the bounds of steps.
  double work_of_bound() const { return work_of_bound_; }
  /// Returns false if the frame has spent its budget.
  bool may_go_on() const { return fixed() || spent_ < most_; }

  const Hysteresis& hysteresis() const { return hysteresis_; }
  void set_hysteresis(const Hysteresis& hysteresis) { hysteresis_ = hysteresis; }

 private:
  void choose(const StepBound& bound, const FrameConditions& conditions);
  double explicit_rate(const StepBound& bound);
  double implicit_rate(const StepBound& bound) const;

  const Integrator* chosen_ = nullptr;
  int fixed_steps_ = 0;  // 0: not fixed
  WorkBudget budget_;
  Hysteresis hysteresis_;
  double seconds_ = 0;  // how long this frame is
  // Of work in this frame; the last is its budget.
  double work_of_substep_ = 0, work_of_bound_ = 0, spent_ = 0, most_ = 0;
  StepPlan plan_;
};

}  // namespace softbody
