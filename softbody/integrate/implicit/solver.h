#pragma once
// One implicit step of up to eight bodies of one model, in double: a quasi-Newton solve (Liu, Bouaziz and Kavan
// 2017, "Quasi-Newton methods for real-time simulation of hyperelastic materials") for the positions X with
//
//   m (X - y) / h^2 = f(X) + damping + contacts,   y = x + h v + h^2 a,
//
// in a frame that moves with the body (implicit/frames.h), where a is what is felt there: springs, gas and dampers know
// no other place or direction than each other's.
//
// Directions come from the last few gradients (L-BFGS) around the prefactored matrix of implicit/matrix.h; a step that
// passes the minimum along its direction is shortened by the secant of the slopes, so that no energy, and no logarithm
// of it, is needed. Contact with solids is implicit, too (Otaduy et al. 2009, "Implicit contact handling for deformable
// objects"): rounds of this solve with the contact forces held, and of projected Gauss-Seidel for these forces,
// Coulomb's cone included, on the compliance that the matrix gives the touching particles. A body that is crushed is
// not what the matrix says; there springs between particles and planes lead the rounds. Penalty contacts with other
// bodies enter to first order.

#include <array>
#include <functional>
#include <memory>
#include <utility>

#include "softbody/forces/kernels.h"
#include "softbody/integrate/implicit/kernels.h"
#include "softbody/integrate/implicit/matrix.h"
#include "softbody/state/lanes.h"

namespace softbody {

/// The plane of a solid that a particle must stay in front of, and the contact force.
struct PlaneContact {
  std::size_t at;  // particle * lanes + lane
  double friction, restitution;
  glm::dvec3 normal;        // unit
  double min_displacement;  // m, that the particle has to move along the normal in this step
  double out;               // m, what of that takes it out of the solid
  glm::dvec3 force{0.0};    // N
};

/// The penalty contact between a particle of the batch and one of another body, to first order.
struct LinearPenaltyPair {
  std::size_t at;     // particle * lanes + lane
  glm::dvec3 normal;  // unit, towards the particle
  PenaltyContact::Slopes slopes;
  glm::dvec3 force{0.0};  // N, on it at the start
  double friction = 0;
  glm::dvec3 partner{0.0};           // m, how far the other particle is taken to move
  glm::dvec3 start_separation{0.0};  // m, how far the two separate at the first velocities; in `force`
  double max_work = 0;               // J, that it can do in the step, whatever force_after() says

  /// Returns the force (N) after the particle has moved by u. It never pulls, and friction does not exceed its limit.
  glm::dvec3 force_after(const glm::dvec3& u) const;
};

struct ImplicitProblem {
  const BodyModel& model;
  const ImplicitMatrix& matrix;
  double h;                           // s
  const float* moves;                 // lanes values
  const Lanes *x, *v;                 // at the start
  const Lanes* a;                     // m/s^2, what acts beside the forces
  const Lanes* frame_displacement;    // m, what particles move without leaving their places here (implicit/frames.h)
  std::vector<PlaneContact>* planes;  // ordered by lanes; their forces are filled in
  const std::vector<LinearPenaltyPair>* penalty_pairs;
};

class ImplicitSolver {
 public:
  ImplicitSolver(const BodyModel& model, const ImplicitKernels& kernels);

  /// Solves a step and returns the positions at its end. converged(lane): their error is below 1e-9 of the radius.
  const Lanes& solve(const ImplicitProblem& problem);
  bool converged(int lane) const { return converged_[std::size_t(lane)]; }
  /// Returns the work since the last call: iterations times particles, and other work in the same unit.
  double take_work() { return std::exchange(work_, 0.0); }

 private:
  using PerLane = std::array<double, lanes>;
  static constexpr std::size_t history = 6;
  static constexpr int max_iterations = 40, iterations_of_round = 12, max_halvings = 6;

  Field<double> field(Lanes& v) const { return {v.data(), v.data() + stride_, v.data() + 2 * stride_}; }
  Field<const double> field(const Lanes& v) const { return {v.data(), v.data() + stride_, v.data() + 2 * stride_}; }
  /// Returns the displacement (m) of a particle in this step.
  glm::dvec3 moved(const ImplicitProblem& p, const Lanes& x, std::size_t at) const {
    return read(x, at) - read(*p.x, at) + read(*p.frame_displacement, at);
  }
  void predict(const ImplicitProblem& p);
  void stop_at_planes(const ImplicitProblem& p);
  void fit_rotation(const ImplicitProblem& p);
  void gradient(const ImplicitProblem& p, const Lanes& x, Lanes& g);
  void add_contact_forces(const ImplicitProblem& p, const Lanes& x, Lanes& f);
  glm::dvec3 contact_force(const ImplicitProblem& p, const PlaneContact& c, const glm::dvec3& u) const;
  std::array<bool, lanes> solve_contact_forces(const ImplicitProblem& p);
  void solve_penalty(const ImplicitProblem& p);
  PerLane project_contacts(const ImplicitProblem& p);
  double project_contacts_of_lane(const ImplicitProblem& p, std::span<PlaneContact> planes);
  bool minimise(const ImplicitProblem& p, int iterations);
  void direction(const ImplicitProblem& p);
  void apply_matrix(const ImplicitProblem& p, Lanes& q);
  PerLane product(const Lanes& a, const Lanes& b) const;
  void add_scaled(const PerLane& times, const Lanes& a, Lanes& y) const;
  void line_search(const ImplicitProblem& p);
  void stay(std::size_t lane);
  void remember();

  const ImplicitKernels& kernels_;
  const ImplicitForceKernels& forces_;
  std::size_t particles_, stride_;  // stride: of a component
  HeldForces held_;                 // found where the solve begins
  Lanes target_, x_, trial_, gradient_, trial_gradient_, direction_, scratch_;
  std::array<Lanes, history> steps_, changes_;
  std::array<PerLane, history> curvature_;  // 1 / (step . change), or 0
  std::size_t remembered_ = 0, newest_ = 0;
  PerLane step_{}, max_step_{};  // max_step: m, of one iteration, the root of the mean square
  alignas(64) double rotation_[9][lanes];
  bool contact_springs_ = false;        // while they lead
  std::array<bool, lanes> given_up_{};  // where contact forces by the matrix cannot be found
  std::array<bool, lanes> converged_{};
  PerLane moves_left_{};  // by contacts, before they are given up
  double work_ = 0;
};

/// Workspace in which a thread solves the batches of one body model.
struct ImplicitWork {
  ImplicitWork(const BodyModel& model, const ImplicitKernels& kernels);
  ImplicitSolver solver;
  Lanes x, v, end_x, end_v;                  // in the world
  Lanes local_x, local_v, stage_x, stage_v;  // in the lanes' frames
  Lanes a, stage_a, frame_displacement;
  std::array<float, lanes> moves{};
  std::vector<PlaneContact> planes;
  std::vector<LinearPenaltyPair> penalty_pairs;
};

}  // namespace softbody
