#pragma once
// How many substeps a stretch of time takes.

#include <algorithm>

namespace softbody {

/// What bounds substeps in a state of the bodies.
struct SubstepBound {
  double stable_step;       // s, that is stable: infinite for integrators that are at any step
  double min_substeps;      // of the stretch: those that keep up with the fastest body near a solid
  double deformation_rate;  // 1/s, that keep up with the body that changes its shape fastest
  double free_rate;         // 1/s, that are stable for what bodies do by themselves, contacts apart

  /// Implicit steps a second that keep up with that body: a tenth as many, for one that bends it by more than its
  /// radius leaves no round body round. None is needed for stability, so there is an end to them. frame: s.
  double implicit_rate(double frame) const { return std::min(0.1 * deformation_rate, 16 / frame); }
};

/// Substeps a second that bodies asked for by themselves: no fewer are taken for half a second to one second more.
/// Steps of one length keep the energy of a swing within bounds; where they get longer and shorter as it swings, they
/// feed it, however short they are (Skeel and Gear 1992, "Does variable step size ruin a symplectic integrator?").
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
