// Dynamics: the choice of the integrator for a frame.

#include <algorithm>
#include <cmath>

#include "softbody/integrate/dynamics.h"

namespace softbody {

/// m/s: how fast the fastest swing goes on by what is lost where positions are rounded to floats; `step` is its bound.
double Dynamics::rounding_velocity(double step) const {
  constexpr double rounding = 1.0 / (1 << 24);
  double farthest = 0;
  for (const Batch* b : crew_.moving()) {
    const Extent e = extent(*b, x_, v_);
    for (int l = 0; l < b->used; ++l)
      for (const LaneVector* corner : {&e.lo, &e.hi})
        farthest = std::max(
            {farthest, double(std::abs(corner->x[l])), double(std::abs(corner->y[l])), double(std::abs(corner->z[l]))});
  }
  return rounding * farthest * 1.6 / step;  // the bound is 0.8 (2 / omega), or less
}

/// The cheaper of the two by the counts of their work, whatever the machine: a step of the quasi-Newton solver is worth
/// about as much as 150 explicit substeps of the same body in free flight, as 300 on solids, and in heaps, where all
/// bodies of a batch take as long as the one that is pressed most, as 1,700 to 4,400. Both are as many as would be
/// taken: what is held counts, or a body that swings would change its integrator with every swing. What might come to
/// ask for more explicit substeps than there may be is left to the other, and what they cannot bring to rest, or near
/// enough for it to fall asleep; unless there the fastest asks for too many implicit ones. Where somebody waits for the
/// frames of a large world, both are cut alike, so that the choice is the same.
void Dynamics::choose_integrator(double seconds) {
  constexpr double in_flight = 150, on_solids = 300, most = max_substeps / 2;  // substeps
  integrator_ = find_integrator("semi-implicit-euler");
  const SubstepBound b = bound(seconds);
  const auto& moving = crew_.moving();
  const bool solid = std::ranges::any_of(moving, [](const Batch* m) { return !m->near_solids.empty(); });
  const double steps = std::max(b.min_substeps, seconds * b.implicit_rate(seconds));
  const double worth = penalty_.pairs.empty() ? std::min(most, (solid ? on_solids : in_flight) * steps) : most;
  if (!fixed_substeps_) raise_min_substep_rate(b, seconds);
  const double held = fixed_substeps_ ? 0 : substep_hysteresis_.rate();
  const double needed = std::max(seconds / b.stable_step, seconds * std::max(b.deformation_rate, held));
  const bool cheaper = needed <= (fixed_substeps_ ? double(*fixed_substeps_) : worth) ||
                       (!fixed_substeps_ && b.min_substeps > max_implicit_steps && needed <= max_substeps);
  const double rest = std::max(1e-3, 0.2 * scene_.sleep.speed);  // m/s
  if (cheaper && rounding_velocity(b.stable_step) <= rest) {
    why_ = "explicit substeps are stable, and cheaper than implicit steps";
  } else if (has_surface_) {
    why_ = "contact of the true surfaces wants short steps";
  } else if (std::ranges::any_of(moving, [](const Batch* m) { return m->particles() > max_implicit_particles; })) {
    why_ = "a body has too many particles for implicit steps";
  } else {
    integrator_ = find_integrator("implicit");
    why_ = cheaper ? "so stiff that in explicit substeps rounding would keep bodies trembling"
                   : "so stiff, or deforming so fast, that explicit substeps would cost more or might be too many";
  }
}

}  // namespace softbody
