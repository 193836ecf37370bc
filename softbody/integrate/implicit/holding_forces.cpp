#include "softbody/integrate/implicit/holding_forces.h"

#include <algorithm>
#include <cmath>

namespace softbody {

/// Without rotation the axes share one factor.
void HoldingForces::factorise(const ImplicitMatrix& matrix, std::span<const HeldEnd> held) {
  const std::size_t axes = matrix.rotates() ? 3 : 1;
  const auto compliance = [&](std::size_t row, std::size_t column) {
    const auto particle = [&](std::size_t i) { return Index(held[i / axes].at / implicit_lanes); };
    return matrix.compliance(particle(row), particle(column))[int(column % axes)][int(row % axes)];
  };
  factor_.clear();
  for (std::size_t i = 0; i < axes * held.size(); ++i) {
    std::vector<double>& row = factor_.emplace_back();
    for (std::size_t j = 0; j <= i; ++j) {
      double rest = compliance(i, j);
      for (std::size_t k = 0; k < j; ++k) rest -= row[k] * factor_[j][k];
      row.push_back(j < i ? rest / factor_[j][j] : std::sqrt(std::max(rest, 1e-12 * compliance(i, i))));
    }
  }
}

void HoldingForces::find_forces(const ImplicitMatrix& matrix, std::span<const HeldEnd> held,
                                std::span<glm::dvec3> moved) {
  std::vector<std::size_t> particles;
  for (const HeldEnd& one : held) particles.push_back(one.at / implicit_lanes);
  const double first = matrix.compliance(Index(particles[0]), Index(particles[0]))[0][0];
  if (first_compliance_ != first || held_ != particles) {
    factorise(matrix, held);
    first_compliance_ = first;
    held_ = std::move(particles);
  }
  const std::size_t axes = matrix.rotates() ? 3 : 1, size = factor_.size();
  for (int axis = 0; axis < 3; axis += int(axes)) {
    const auto at = [&](std::size_t i) -> double& { return moved[i / axes][axis + int(i % axes)]; };
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t k = 0; k < i; ++k) at(i) -= factor_[i][k] * at(k);
      at(i) /= factor_[i][i];
    }
    for (std::size_t i = size; i-- > 0;) {
      for (std::size_t k = i + 1; k < size; ++k) at(i) -= factor_[k][i] * at(k);
      at(i) /= factor_[i][i];
    }
  }
}

}  // namespace softbody
