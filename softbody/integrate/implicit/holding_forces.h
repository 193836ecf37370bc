#pragma once
// The forces that keep particles where they are held in an implicit step.

#include <span>
#include <vector>

#include "softbody/integrate/implicit/problem.h"

namespace softbody {

/// Those of the body in one lane. It keeps the factor of the compliances of its held particles among one another.
class HoldingForces {
 public:
  /// Replaces the displacements (m) of held particles by the forces (N) that cause them, in the matrix's axes.
  void find_forces(const ImplicitMatrix& matrix, std::span<const HeldEnd> held, std::span<glm::dvec3> moved);

 private:
  void factorise(const ImplicitMatrix& matrix, std::span<const HeldEnd> held);

  double first_compliance_ = 0;              // m/N, of the first of them: it tells matrices of a model apart
  std::vector<std::size_t> held_;            // the particles
  std::vector<std::vector<double>> factor_;  // of Cholesky, by rows
};

}  // namespace softbody
