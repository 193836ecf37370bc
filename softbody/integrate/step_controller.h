#pragma once
// Decides which integrator a frame gets, and how many substeps. It sees no bodies, only numbers that say how they are.

#include <optional>
#include <string_view>

#include "softbody/integrate/integrators.h"
#include "softbody/integrate/max_work.h"
#include "softbody/integrate/substeps.h"

namespace softbody {

/// What else the choice of an integrator depends on.
struct FrameConditions {
  bool near_solids = false, penalty_pairs = false, surface_contact = false;
  bool too_large = false;        // a body has too many particles for implicit steps
  double rounding_velocity = 0;  // m/s, see StepBounds::rounding_velocity()
  double sleep_speed = 0;        // m/s, below which bodies fall asleep
};

/// Work of a frame, each as MaxWork counts it.
struct FrameWork {
  double surface = 0, implicit = 0, penalty = 0;
};

class StepController {
 public:
  void set_integrator(const Integrator& integrator);
  /// Fixes the number of the integrator's steps in a frame; nullopt: as many as the bounds ask for.
  void set_fixed_steps(std::optional<int> steps) { fixed_steps_ = steps; }
  void set_max_work(const MaxWork& max) { max_work_ = max; }

  /// particles: of all bodies.
  void begin_frame(double seconds, std::size_t particles);
  /// True if the controller chooses the integrator of each frame.
  bool automatic() const { return chosen_->automatic; }
  /// Chooses the integrator of this frame. bound: of semi-implicit Euler.
  void choose(const SubstepBound& bound, const FrameConditions& conditions);
  /// Returns the integrator of this frame and why the controller chose it, which is empty if it did not.
  const Integrator& integrator() const { return *integrator_; }
  std::string_view why() const { return why_; }

  bool fixed() const { return fixed_steps_.has_value(); }
  /// Returns the largest number of substeps of this frame.
  int max_substeps() const;
  /// Returns into how many substeps the last `left` seconds of the frame are to be divided for these bounds.
  int stable_substeps(const SubstepBound& bound, double left);
  /// Returns the same if contacts ask for a rate of substeps (1/s), too.
  int substeps(int stable, double contact_rate, double left) const;
  /// Adds to the work of this frame.
  void spend(const FrameWork& work);
  /// Returns false if the frame has had as many substeps, or as much work, as it may.
  bool may_go_on(int substeps) const;

  /// Returns the most candidates of surface contact at one time.
  std::size_t max_candidates() const { return max_work_.candidates(particles_); }
  const SubstepHysteresis& hysteresis() const { return hysteresis_; }
  void set_hysteresis(const SubstepHysteresis& hysteresis) { hysteresis_ = hysteresis; }

 private:
  int max_explicit_substeps() const { return max_work_.scaled_substeps(softbody::max_substeps, particles_); }
  void raise_min_substep_rate(const SubstepBound& bound);

  const Integrator *chosen_ = nullptr, *integrator_ = nullptr;
  std::string_view why_;
  std::optional<int> fixed_steps_;
  MaxWork max_work_;
  SubstepHysteresis hysteresis_;
  double seconds_ = 0;  // of this frame
  std::size_t particles_ = 0;
  FrameWork work_;
};

/// Returns the substeps that a bound asks for within `seconds`, at least `at_least`.
int count_substeps(const SubstepBound& bound, double seconds, double at_least);

}  // namespace softbody
