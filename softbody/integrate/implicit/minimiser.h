#pragma once
// The minimum of one function a lane, by L-BFGS (Nocedal 1980).

#include <array>
#include <functional>
#include <utility>

#include "softbody/integrate/implicit/kernels.h"
#include "softbody/integrate/implicit/problem.h"

namespace softbody {

using PerLane = std::array<double, implicit_lanes>;

/// What is minimised, each lane by itself: f(x) with the gradient g and an approximation A of the second derivative.
struct Objective {
  std::function<void(const Lanes& x, Lanes& g)> gradient;
  std::function<void(Lanes& q)> apply_inverse;  // q = A^-1 q
};

/// Directions come from the last few gradients around the matrix A. A step that passes the minimum along its direction
/// is shortened by the secant of the slopes, so that no value of the function is needed.
class Minimiser {
 public:
  explicit Minimiser(std::size_t particles);

  /// Forgets what earlier calls have learnt of the function.
  void forget() { remembered_ = 0; }
  /// Moves x to the minimum, in so many iterations at most. In one of them a lane moves by at most max_step, and it has
  /// converged if it moves by at most `enough` (both m, roots of mean squares). Returns true if all lanes have.
  bool minimise(const Objective& objective, Lanes& x, const PerLane& max_step, double enough, int iterations);
  /// Returns the lanes that have converged in the last call.
  LaneMask converged() const { return converged_; }
  /// Returns the work since the last call: iterations times particles.
  double take_work() { return std::exchange(work_, 0.0); }

 private:
  static constexpr std::size_t history = 6;

  PerLane product(const Lanes& a, const Lanes& b) const;
  void add_scaled(const PerLane& times, const Lanes& a, Lanes& y) const;
  void find_direction(const Objective& objective);
  void search_line(const Objective& objective, const Lanes& x, const PerLane& max_step);
  void remember(const Lanes& x);

  const ImplicitKernels& kernels_;
  std::size_t particles_;
  Lanes trial_, gradient_, trial_gradient_, direction_;
  std::array<Lanes, history> steps_, changes_;
  std::array<PerLane, history> curvature_;  // 1 / (step . change), or 0
  std::size_t remembered_ = 0, newest_ = 0;
  LaneMask converged_;
  double work_ = 0;
};

}  // namespace softbody
