#pragma once
// What bounds the steps of a frame, measured on the bodies as they are.

#include "softbody/contact/solid_contact.h"
#include "softbody/forces/force_set.h"
#include "softbody/integrate/integrators.h"
#include "softbody/integrate/substeps.h"

namespace softbody {

class StepBounds {
 public:
  /// All of these must outlive this.
  StepBounds(const State& state, const PenaltyContact& penalty, const SolidContact& solids)
      : state_(state), penalty_(penalty), solids_(solids) {}

  /// Returns the bounds for the next `seconds` with this integrator.
  SubstepBound measure(const Integrator& integrator, double seconds);
  /// Returns for how many substeps of h seconds measure() may be trusted. It is to be called again before the fastest
  /// body has moved a fifth of its radius, since a body that is being crushed gets stiffer, or about a quarter of the
  /// contact layer's thickness, since a contact that is being pressed damps more.
  int trusted_substeps(std::span<const Batch* const> moving, double h) const;
  /// Returns the speed (m/s) at which the fastest oscillation goes on by what is lost where positions are rounded to
  /// floats. stable_step: of explicit steps, s.
  double rounding_velocity(std::span<const Batch* const> moving, double stable_step) const;

 private:
  const State& state_;
  const PenaltyContact& penalty_;
  const SolidContact& solids_;
  VectorArray area_;                    // m^2, scratch
  std::vector<float> penalty_damping_;  // N s/m of each particle, scratch
};

/// Returns how many substeps a frame needs for a body of this model in its starting shape. thickness: of the contact
/// layer, m; max_friction: the largest friction of any material.
double substeps_at_start(const BodyModel& model, const Integrator& integrator, double frame_time, float thickness,
                         double max_friction);

}  // namespace softbody
