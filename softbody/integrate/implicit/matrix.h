#pragma once
// The matrix that implicit steps share: mass over h^2 plus the stiffness and damping of a body model at its shape in
// balance, factored once for a step length and used by all bodies of the model.
//
// A closed body deforms little where it is stiff, so its matrix, turned with it, is nearly the true one, or if that is
// not positive definite, its springs along their directions and pulling across them. An open sheet folds; there each
// spring is k times the identity, as in projective dynamics (Bouaziz et al. 2014), which no direction exceeds. How gas
// is compressed is one more direction, the gradient of the volume, by Sherman and Morrison's formula.

#include <memory>
#include <vector>

#include <glm/mat3x3.hpp>

#include "softbody/integrate/implicit/kernels.h"
#include "softbody/model/body_model.h"
#include "softbody/state/lanes.h"

namespace softbody {

class ImplicitMatrix {
 public:
  /// Makes the matrix for steps of h (s). `other`: one of the same body model, to take the shape in balance from.
  /// Throws SceneError if the matrix cannot be factored.
  ImplicitMatrix(const BodyModel& model, double h, const ImplicitMatrix* other = nullptr);
  ~ImplicitMatrix();

  /// Returns true if components are coupled (unknown k * particles + i), in the axes of the starting shape. Else the
  /// factor serves each of them.
  bool rotates() const { return rotates_; }
  const CholeskyFactor& factor() const { return factor_; }
  const std::vector<glm::dvec3>& shape() const { return shape_; }  // m, the starting shape from its mean
  // The gas, empty without: gradient g of the volume in m^2, A^-1 g, and s / (1 + s g . A^-1 g), s = -dP/dV in Pa/m^3.
  const std::vector<double>& gas() const { return gas_; }
  const std::vector<double>& gas_response() const { return gas_response_; }
  double gas_weight() const { return gas_weight_; }

  double contact_stiffness() const { return contact_stiffness_; }  // N/m, about that of one particle

  /// Returns how particle i moves (m/N) under a force on particle j, in the matrix's axes. Works out what belongs to j
  /// once, on whatever thread asks first.
  glm::dmat3 compliance(Index i, Index j) const;

 private:
  struct Factored;
  void solve_columns(Index j) const;

  bool rotates_;
  std::shared_ptr<const std::vector<glm::dvec3>> balanced_;  // where the mesh's vertices are in balance
  CholeskyFactor factor_;
  std::vector<glm::dvec3> shape_;
  std::vector<double> gas_, gas_response_;
  double gas_weight_ = 0, contact_stiffness_ = 0;
  std::unique_ptr<Factored> factored_;
};

}  // namespace softbody
