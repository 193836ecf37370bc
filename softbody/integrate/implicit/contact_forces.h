#pragma once
// The forces of solids on the bodies of an implicit step.

#include <utility>

#include "softbody/integrate/implicit/problem.h"

namespace softbody {

/// Searches for the forces that keep points in front of their planes, with friction in Coulomb's cone. It works on
/// the compliance that the matrix gives the touching points. A crushed body is not what the matrix says: for that
/// one, springs between points and planes can lead the search.
class ContactForces {
 public:
  /// Forces hold if no change of one moves a point by more than this share of the radius.
  static constexpr double held_within = 1e-7;

  bool springs_lead() const { return springs_lead_; }
  /// Starts a search in all lanes, which springs lead or not.
  void start(bool springs_lead);
  /// Returns the force (N) on a point that has moved by u (m): the one that is held and, while springs lead, one on
  /// what is left to correct.
  glm::dvec3 force(const ImplicitProblem& problem, const PlaneContact& contact, const glm::dvec3& u) const;
  /// Brings the forces of one lane's contacts up to date with the positions x, and adds their changes to `changes`.
  /// Returns how far (m) a force's change has moved its point at most. Where no forces are found, changes nothing
  /// and returns infinity, or 0 while springs lead. `rotation`: of the matrix, for this lane.
  double update(const ImplicitProblem& problem, std::span<PlaneContact> contacts, const Lanes& x,
                const glm::dmat3& rotation, Lanes& changes);
  /// Returns the work since the last call, in iterations of the solver times particles.
  double take_work() { return std::exchange(work_, 0.0); }

 private:
  bool springs_lead_ = false;
  std::array<double, implicit_lanes> moves_left_{};  // of contacts by contacts, before no forces are found
  double work_ = 0;
};

}  // namespace softbody
