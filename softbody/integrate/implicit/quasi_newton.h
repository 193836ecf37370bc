#pragma once
// One implicit step of up to eight bodies of one model, in double: a quasi-Newton solve (Liu, Bouaziz and Kavan
// 2017, "Quasi-Newton methods for real-time simulation of hyperelastic materials") for the positions X with
//
//   m (X - y) / h^2 = f(X) + damping + contacts,   y = x + h v + h^2 a,
//
// in axes that move with the body (implicit/moving_axes.h), where a is what is felt there: springs, gas and dampers
// know no other place or direction than each other's.
//
// It goes by gradients (implicit/minimiser.h) around a prefactored matrix (implicit/matrix.h), so that no energy, and
// no logarithm of it, is needed. Contact with solids is implicit, too (Otaduy et al. 2009, "Implicit contact handling
// for deformable objects"): rounds of this solve with the contact forces held, and of a search for these forces
// (implicit/contact_forces.h). Penalty contacts with other bodies enter to first order.

#include <utility>

#include "softbody/integrate/implicit/contact_forces.h"
#include "softbody/integrate/implicit/kernels.h"
#include "softbody/integrate/implicit/minimiser.h"
#include "softbody/integrate/implicit/problem.h"
#include "softbody/mechanics/kernels.h"
#include "softbody/state/lanes.h"

namespace softbody {

class QuasiNewton {
 public:
  explicit QuasiNewton(const BodyModel& model);

  /// Solves a step and returns the positions at its end.
  const Lanes& solve(const ImplicitProblem& problem);
  /// Returns the lanes whose positions have, at the end of the last solve, an error below 1e-9 of the radius.
  LaneMask converged() const { return minimiser_.converged(); }
  /// Returns the work since the last call: iterations times particles, and other work in the same unit.
  double take_work() { return std::exchange(work_, 0.0) + minimiser_.take_work() + contact_.take_work(); }

 private:
  void predict(const ImplicitProblem& p);
  void stop_at_planes(const ImplicitProblem& p);
  void fit_rotation(const ImplicitProblem& p);
  void gradient(const ImplicitProblem& p, const Lanes& x, Lanes& g);
  void add_contact_forces(const ImplicitProblem& p, const Lanes& x, Lanes& f);
  void apply_matrix(const ImplicitProblem& p, Lanes& q);
  void apply_free_matrix(const ImplicitProblem& p, Lanes& q);
  glm::dmat3 rotation(const ImplicitProblem& p, std::size_t lane) const;
  bool minimise(const ImplicitProblem& p, int iterations);
  LaneMask solve_contact(const ImplicitProblem& p);
  void solve_contact_by_springs(const ImplicitProblem& p);
  PerLane update_contact_forces(const ImplicitProblem& p, LaneMask which);

  const ImplicitKernels& kernels_;
  const ImplicitForceKernels& forces_;
  std::size_t particles_, stride_;  // stride: of a component
  HeldForces held_;                 // found where the solve begins
  Minimiser minimiser_;
  ContactForces contact_;
  Lanes target_, x_, push_, scratch_;  // push: changes of contact forces, and what they move
  Lanes forces_on_free_;               // room for what apply_matrix() begins with, where particles are held
  PerLane max_step_{};                 // m, of one iteration, the root of the mean square
  alignas(64) double rotation_[9][implicit_lanes];
  double work_ = 0;  // beside that of the minimiser and of the contact forces
};

}  // namespace softbody
