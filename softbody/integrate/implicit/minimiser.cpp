#include "softbody/integrate/implicit/minimiser.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace softbody {

Minimiser::Minimiser(std::size_t particles) : kernels_(implicit_kernels()), particles_(particles) {
  for (Lanes* v : {&trial_, &gradient_, &trial_gradient_, &direction_}) v->resize(3 * particles * implicit_lanes);
  for (auto* list : {&steps_, &changes_})
    for (Lanes& v : *list) v.resize(3 * particles * implicit_lanes);
}

PerLane Minimiser::product(const Lanes& a, const Lanes& b) const {
  PerLane result;
  kernels_.inner_product(3 * particles_, a.data(), b.data(), result.data());
  return result;
}

void Minimiser::add_scaled(const PerLane& times, const Lanes& a, Lanes& y) const {
  kernels_.add_scaled(3 * particles_, times.data(), a.data(), y.data());
}

/// Sets the direction by two loops over the history, from the newest step to the oldest and back.
void Minimiser::find_direction(const Objective& objective) {
  std::array<PerLane, history> weight;
  direction_ = gradient_;
  const auto back = [this](std::size_t age) { return (newest_ + history - age) % history; };
  for (std::size_t age = 0; age < remembered_; ++age) {
    const std::size_t i = back(age);
    weight[i] = product(steps_[i], direction_);
    PerLane less;
    for (std::size_t l = 0; l < implicit_lanes; ++l) less[l] = -(weight[i][l] *= curvature_[i][l]);
    add_scaled(less, changes_[i], direction_);
  }
  objective.apply_inverse(direction_);
  for (std::size_t age = remembered_; age-- > 0;) {
    const std::size_t i = back(age);
    PerLane more = product(changes_[i], direction_);
    for (std::size_t l = 0; l < implicit_lanes; ++l) more[l] = weight[i][l] - curvature_[i][l] * more[l];
    add_scaled(more, steps_[i], direction_);
  }
  for (double& d : direction_) d = -d;
}

/// Sets the trial to a step along the direction, so short that the slope has not turned steeply upwards. A lane whose
/// gradient is not finite there stays at x.
void Minimiser::search_line(const Objective& objective, const Lanes& x, const PerLane& max_step) {
  constexpr int max_halvings = 6;
  const PerLane slope = product(gradient_, direction_), length2 = product(direction_, direction_);
  PerLane step;
  for (std::size_t l = 0; l < implicit_lanes; ++l) {
    // A slope upwards: at the minimum, or lost. A lane that has converged stays, whatever the others still need.
    const bool stays = !(slope[l] < 0) || !std::isfinite(slope[l]) || converged_[l];
    step[l] = stays ? 0 : std::min(1.0, max_step[l] / std::sqrt(length2[l] / double(particles_)));
  }
  PerLane end;
  for (int halving = 0;; ++halving) {
    trial_ = x;
    add_scaled(step, direction_, trial_);
    objective.gradient(trial_, trial_gradient_);
    end = product(trial_gradient_, direction_);
    bool short_enough = true;
    for (std::size_t l = 0; l < implicit_lanes; ++l) {
      if (step[l] <= 0 || end[l] <= -0.9 * slope[l]) continue;
      const double secant = slope[l] / (slope[l] - end[l]);
      step[l] *= std::isfinite(secant) ? std::clamp(secant, 0.1, 0.6) : 0.1;
      short_enough = false;
    }
    if (short_enough || halving == max_halvings) break;
  }
  for (std::size_t l = 0; l < implicit_lanes; ++l) {
    if (std::isfinite(end[l])) continue;
    for (std::size_t i = l; i < x.size(); i += implicit_lanes) {
      trial_[i] = x[i];
      trial_gradient_[i] = gradient_[i];
    }
  }
}

/// Adds the step from x to the trial to the history. In a lane where it saw no curvature it does not count.
void Minimiser::remember(const Lanes& x) {
  newest_ = (newest_ + 1) % history;
  remembered_ = std::min(remembered_ + 1, history);
  Lanes &s = steps_[newest_], &y = changes_[newest_];
  for (std::size_t i = 0; i < x.size(); ++i) {
    s[i] = trial_[i] - x[i];
    y[i] = trial_gradient_[i] - gradient_[i];
  }
  const PerLane sy = product(s, y), yy = product(y, y), ss = product(s, s);
  for (std::size_t l = 0; l < implicit_lanes; ++l)
    curvature_[newest_][l] = sy[l] > 1e-10 * std::sqrt(ss[l] * yy[l]) ? 1 / sy[l] : 0;
}

bool Minimiser::minimise(const Objective& objective, Lanes& x, const PerLane& max_step, double enough, int iterations) {
  assert(x.size() == gradient_.size());
  objective.gradient(x, gradient_);
  converged_.reset();
  for (int i = 0; i < iterations && !converged_.all(); ++i) {
    work_ += double(particles_);
    find_direction(objective);
    search_line(objective, x, max_step);
    remember(x);
    std::swap(x, trial_);
    std::swap(gradient_, trial_gradient_);
    const PerLane square = product(steps_[newest_], steps_[newest_]);
    for (std::size_t l = 0; l < implicit_lanes; ++l) converged_[l] = square[l] <= enough * enough * double(particles_);
  }
  return converged_.all();
}

}  // namespace softbody
