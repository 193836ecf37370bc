#include "softbody/integrate/step_controller.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace softbody {
namespace {

constexpr double unbounded_substeps = 1e9;  // far more than there may be: less of the frame is simulated

}  // namespace

int count_substeps(const SubstepBound& b, double seconds, double at_least) {
  return int(std::min(unbounded_substeps, std::ceil(std::max({b.min_substeps, seconds / b.stable_step, at_least}))));
}

void StepController::set_integrator(const Integrator& integrator) {
  chosen_ = integrator_ = &integrator;
  why_ = {};
}

void StepController::begin_frame(double seconds, std::size_t particles) {
  assert(chosen_ && seconds > 0);
  seconds_ = seconds;
  particles_ = particles;
  work_ = {};
  hysteresis_.advance(seconds);
}

/// No rate that is kept may cut the frame short.
void StepController::raise_min_substep_rate(const SubstepBound& b) {
  hysteresis_.raise(std::min(std::max(b.free_rate, b.deformation_rate), max_explicit_substeps() / seconds_));
}

/// Takes the cheaper of the two by the counts of their work, whatever the machine: a step of the quasi-Newton solver is
/// worth about as much as 150 explicit substeps of the same body in free flight, as 300 on solids, and in heaps, where
/// all bodies of a batch take as long as the one that is pressed most, as 1,700 to 4,400. Both are as many as would be
/// taken: the rate that is kept counts, or a body that oscillates would change its integrator with every swing. What
/// might come to ask for more explicit substeps than there may be gets implicit steps, and what explicit substeps
/// cannot bring to rest, or near enough to it to fall asleep; unless the fastest body asks for too many implicit ones.
/// Where somebody waits for the frames of a large world, both are cut alike, so that the choice is the same.
void StepController::choose(const SubstepBound& b, const FrameConditions& c) {
  constexpr double in_flight = 150, on_solids = 300, most = softbody::max_substeps / 2;  // substeps
  assert(automatic());
  integrator_ = find_integrator("semi-implicit-euler");
  const double steps = std::max(b.min_substeps, seconds_ * b.implicit_rate(seconds_));
  const double worth = c.penalty_pairs ? most : std::min(most, (c.near_solids ? on_solids : in_flight) * steps);
  if (!fixed()) raise_min_substep_rate(b);
  const double kept = fixed() ? 0 : hysteresis_.rate();
  const double needed = std::max(seconds_ / b.stable_step, seconds_ * std::max(b.deformation_rate, kept));
  const bool cheaper = needed <= (fixed() ? double(*fixed_steps_) : worth) ||
                       (!fixed() && b.min_substeps > max_implicit_steps && needed <= softbody::max_substeps);
  const double rest = std::max(1e-3, 0.2 * c.sleep_speed);  // m/s
  if (cheaper && c.rounding_velocity <= rest) {
    why_ = "explicit substeps are stable, and cheaper than implicit steps";
  } else if (c.surface_contact) {
    why_ = "contact of the true surfaces wants short steps";
  } else if (c.too_large) {
    why_ = "a body has too many particles for implicit steps";
  } else {
    integrator_ = find_integrator("implicit");
    why_ = cheaper ? "so stiff that in explicit substeps rounding would keep bodies trembling"
                   : "so stiff, or deforming so fast, that explicit substeps would cost more or might be too many";
  }
}

int StepController::max_substeps() const {
  if (fixed()) return *fixed_steps_ * integrator_->substeps_per_step;
  return integrator_->implicit ? max_implicit_steps : max_explicit_substeps();
}

int StepController::stable_substeps(const SubstepBound& b, double left) {
  constexpr double nearly = 1 - 1e-9;  // the rest of a frame takes what is left of its substeps, but for rounding
  if (!std::isfinite(b.stable_step)) return count_substeps(b, left, left * b.implicit_rate(seconds_) * nearly);
  raise_min_substep_rate(b);
  return count_substeps(b, left, left * std::max(b.deformation_rate, hysteresis_.rate() * nearly));
}

int StepController::substeps(int stable, double contact_rate, double left) const {
  int count = std::max(stable, int(std::min(unbounded_substeps, std::ceil(left * contact_rate))));
  if (!integrator_->implicit) return count;
  // A matrix belongs to a step length, of which there are to be few: halves, quarters, ... of a frame.
  count = std::min(count, 1 << 20);  // far more than there may be, and lengths still divide what is left
  double length = seconds_;
  const auto fits = [&] { return std::abs(left / length - std::round(left / length)) < 1e-6; };
  while (length > left * (1 + 1e-9) || left / length < count * (1 - 1e-9) || !fits()) length /= 2;
  return int(std::lround(left / length));
}

void StepController::spend(const FrameWork& work) {
  work_.surface += work.surface;
  work_.implicit += work.implicit;
  work_.penalty += work.penalty;
}

bool StepController::may_go_on(int substeps) const {
  if (substeps >= max_substeps()) return false;
  const double times = max_work_.times(particles_);
  return fixed() || (work_.surface < times * max_work_.surface && work_.implicit < times * max_work_.implicit &&
                     work_.penalty < times * max_work_.penalty);
}

}  // namespace softbody
