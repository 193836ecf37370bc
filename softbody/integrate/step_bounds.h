#pragma once
// What bounds the steps of a frame, measured on the bodies as they are.

#include <span>

#include "softbody/contact/solid_contact.h"
#include "softbody/integrate/batch_shares.h"
#include "softbody/integrate/step_controller.h"
#include "softbody/mechanics/force_set.h"

namespace softbody {

class StepBounds {
 public:
  /// All of these must outlive this.
  StepBounds(const State& state, const PenaltyContact& penalty, const SolidContact& solids, const BatchShares& shares)
      : state_(state), penalty_(penalty), solids_(solids), shares_(shares) {}

  /// Returns the bounds of steps of this integrator. No step is to change the shape of a body by more than a tenth of
  /// its radius, nor to move it by more where solids are near.
  StepBound measure(const Integrator& integrator) const;
  /// Returns how many times its radius the fastest body goes in a second, now.
  double fastest() const;
  /// Returns for how many substeps of h seconds the bounds hold: until the fastest body has moved a fifth of its
  /// radius, since a body that is being crushed gets stiffer. It may be 0; then they hold for less than one.
  static int substeps_in_shape(double fastest, double h);
  /// Returns what is lost where positions are rounded to floats, in m. extents: of the batches' positions.
  static double rounding(std::span<const Batch* const> batches, std::span<const Extent> extents);

 private:
  StepBound measure(const Batch& batch, const Integrator& integrator) const;
  static double pace(const Batch& batch, const Extent& motion);

  const State& state_;
  const PenaltyContact& penalty_;
  const SolidContact& solids_;
  const BatchShares& shares_;
};

}  // namespace softbody
