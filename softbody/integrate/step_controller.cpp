#include "softbody/integrate/step_controller.h"

#include <cassert>
#include <cmath>

namespace softbody {
namespace {

constexpr double longest_step =
    1.0 / 60;  // s, of steps that are not fixed: forces are far from linear over longer ones
/// 1/s, of steps that are implicit in the volume. At this rate a ball that is stretched by a fifth and spins is off by
/// less than a hundredth of its radius after half a second, see `report solver`. Bodies that are stable in longer steps
/// take these.
constexpr double accurate_rate = 480;
/// 1/s, of implicit steps where surfaces of bodies may touch. Contact of these acts after the solve, so that it strains
/// springs and gas that do not resist until the next step: the energy of that grows with the square of the step.
constexpr double contact_rate = 480;
/// Share by which volumes may change. Beyond it, breathing feeds other motion, so that it must not be damped away.
constexpr double quiet_breathing = 0.02;
constexpr double max_count = 1e30;   // substeps of a frame: such short ones move nothing, but stay finite
constexpr double max_needed = 5e8;   // substeps as they are reported: an int holds them, and no budget pays for them
constexpr double nearly = 1 - 1e-9;  // rounding of what is left of a frame must not add a substep

/// Returns the number of steps on the ladder that is not below `count`. Between 2^n and 2^(n+1) steps a frame it has
/// `lengths` rungs.
double on_ladder(double count, int lengths) {
  const double whole = std::ceil(std::clamp(count, 1.0, max_count) * nearly);
  const double unit = std::max(1.0, std::ldexp(1.0, std::ilogb(whole)) / lengths);
  return std::ceil(whole / unit) * unit;
}

}  // namespace

void StepController::set_choice(const IntegratorChoice& choice) {
  chosen_ = &choice.integrator();
  fixed_steps_ = choice.substeps.value_or(0);
  plan_ = {};
  plan_.integrator = chosen_;
}

void StepController::begin_frame(const FrameConditions& c, const StepBound& bound) {
  assert(chosen_ && c.seconds > 0);
  seconds_ = c.seconds;
  spent_ = 0;
  most_ = budget_.of(c.particles);
  work_of_substep_ = work::substep + double(c.moving) + work::penalty_pair * double(c.penalty_pairs);
  work_of_bound_ = work::bound * double(c.moving);
  for (RecentMaximum* m : {&hysteresis_.implicit_volume_rate, &hysteresis_.explicit_rate, &hysteresis_.volume_change})
    m->advance(c.seconds);
  plan_.substeps = plan_.needed = 0;
  if (automatic() && c.moving > 0) choose(bound, c);
}

/// What bodies asked for lately counts, too, but no more of it than half of the budget pays for: a need that has passed
/// must not cut frames short.
double StepController::explicit_rate(const StepBound& b) {
  const bool accurate = automatic() && plan_.integrator->implicit_volume;
  const double asked = std::max({stable_rate(b, *plan_.integrator), b.deformation, accurate ? accurate_rate : 0});
  const double rate = std::max({1 / longest_step, b.passing, asked});
  if (fixed()) return rate;
  RecentMaximum& kept =
      plan_.integrator->implicit_volume ? hysteresis_.implicit_volume_rate : hysteresis_.explicit_rate;
  kept.raise(std::min(asked, 0.5 * most_ / work_of_substep_ / seconds_));
  return std::max(rate, kept.value());
}

/// A body does not stay round if a step bends it by more than its radius, ten times as much as `deformation` allows.
/// Stability does not need these steps, so there are at most 16 a frame.
double StepController::implicit_rate(const StepBound& b) const {
  return std::max({1 / longest_step, b.passing, std::min(0.1 * b.deformation, 16 / seconds_)});
}

/// Takes the cheaper of the two by their work, whatever the machine. What explicit substeps cannot bring to rest, or
/// near enough to it to fall asleep, gets implicit ones.
void StepController::choose(const StepBound& b, const FrameConditions& c) {
  const double of_implicit = c.penalty_pairs > 0 ? work::implicit_in_contact
                             : c.near_solids     ? work::implicit_on_solids
                                                 : work::implicit_in_flight;
  hysteresis_.volume_change.raise(b.volume_change);
  // Contact of surfaces wants short steps. It acts after the gas, and would be solved again for each new pressure.
  const bool gas_decides = !c.surfaces_touch && hysteresis_.volume_change.value() <= quiet_breathing &&
                           std::max({accurate_rate, 1 / seconds_, b.stable}) < 0.8 * b.breathing;
  plan_.integrator = &choosable_integrator(false, gas_decides);
  const double most = fixed() ? fixed_steps_ : of_implicit * std::max(1.0, seconds_ * implicit_rate(b));
  const bool cheaper = seconds_ * explicit_rate(b) <= most;
  const double rest = std::max(1e-3, 0.2 * c.sleep_speed);  // m/s
  // The stable step is 0.8 (2 / omega), or less: the speed of the fastest oscillation that rounding keeps alive.
  const double trembling = c.rounding * 1.6 * stable_rate(b, *plan_.integrator);
  if (cheaper && trembling <= rest) {
    plan_.why = gas_decides ? "stiff by its gas only, which alone is taken implicitly"
                            : "explicit substeps are stable, and cheaper than implicit steps";
  } else if (c.surface_contact) {
    plan_.why = "contact of the true surfaces wants short steps";
  } else if (c.too_large) {
    plan_.why = "a body has too many particles for implicit steps";
  } else {
    plan_.integrator = &choosable_integrator(true, false);
    plan_.why = cheaper ? "so stiff that in explicit substeps rounding would keep bodies trembling"
                        : "so stiff, or deforming so fast, that explicit substeps would cost more";
  }
}

const StepPlan& StepController::plan(const StepBound& b, double left) {
  const Integrator& integrator = *plan_.integrator;
  const bool any_step = integrator.stable_at_any_step();
  const double needed = seconds_ * std::max({1 / longest_step, b.passing, stable_rate(b, integrator)});
  plan_.needed = int(std::ceil(std::min(needed, max_needed) * nearly));
  const double own =
      std::max(integrator.substeps_per_step / seconds_, integrator.implicit && b.surfaces_near ? contact_rate : 0);
  const double rate =
      std::max(own, any_step ? std::max(implicit_rate(b), stable_rate(b, integrator)) : explicit_rate(b));
  double count = left / seconds_;
  if (fixed()) {
    count *= fixed_steps_ * integrator.substeps_per_step;
  } else {
    count *= on_ladder(seconds_ * rate, integrator.step_lengths);
    // The rest of a frame may be no whole number of substeps of that length. Then explicit ones become a little
    // shorter; implicit ones, of which each length needs a matrix, are halved until the number is whole.
    while (integrator.implicit && std::abs(count - std::round(count)) > 1e-6) count *= 2;
  }
  plan_.substeps = std::max(1.0, std::ceil(count * nearly));
  return plan_;
}

}  // namespace softbody
