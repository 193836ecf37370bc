#pragma once
// Bounds of the number of substeps.

#include <algorithm>

namespace softbody {

/// Bounds of substeps for a state of the bodies.
struct SubstepBound {
  double stable_step;       // s, that is stable: infinite for integrators that are at any step
  double min_substeps;      // of the stretch: those that keep up with the fastest body near a solid
  double deformation_rate;  // 1/s, that keep up with the body that changes its shape fastest
  double free_rate;         // 1/s, that are stable for what bodies do by themselves, contacts apart

  /// Returns the rate (1/s) of implicit steps that keeps up with the body that deforms fastest: a tenth of
  /// deformation_rate, because a body does not stay round if a step bends it by more than its radius. Stability needs
  /// no such steps, so there are at most 16 a frame. frame: s.
  double implicit_rate(double frame) const { return std::min(0.1 * deformation_rate, 16 / frame); }
};

/// Lower bound of the substep rate that falls with a delay: the largest rate (1/s) that bodies have needed, contacts
/// apart, within the last half second to one second. Steps of equal length keep the energy of an oscillation bounded.
/// Steps that get longer and shorter with the oscillation feed it, however short they are (Skeel and Gear 1992, "Does
/// variable step size ruin a symplectic integrator?").
class SubstepHysteresis {
 public:
  void advance(double seconds) {
    age_ += seconds;
    if (age_ < half_second) return;
    before_ = now_;
    now_ = age_ = 0;
  }
  void raise(double rate) { now_ = std::max(now_, rate); }
  double rate() const { return std::max(now_, before_); }  // 1/s

 private:
  static constexpr double half_second = 0.5;
  double now_ = 0, before_ = 0;  // 1/s, the most in the half second that runs, and in the one before
  double age_ = 0;               // s, of the one that runs
};

}  // namespace softbody
