#include "softbody/model/spring_bound.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Eigenvalues>

namespace softbody {
namespace {

using Vector = Eigen::VectorXd;

class Laplacian {
 public:
  Laplacian(std::size_t particles, std::span<const std::vector<Spring>* const> lists, double Spring::*property)
      : lists_(lists), property_(property), sum_(Vector::Zero(Eigen::Index(particles))) {
    for (const auto* list : lists_)
      for (const Spring& s : *list) {
        sum_[s.i] += s.*property_;
        sum_[s.j] += s.*property_;
      }
  }

  double gershgorin() const { return 2 * sum_.maxCoeff(); }

  Vector operator*(const Vector& v) const {
    Vector result = sum_.cwiseProduct(v);
    for (const auto* list : lists_)
      for (const Spring& s : *list) {
        result[s.i] -= s.*property_ * v[s.j];
        result[s.j] -= s.*property_ * v[s.i];
      }
    return result;
  }

 private:
  std::span<const std::vector<Spring>* const> lists_;
  double Spring::*property_;
  Vector sum_;
};

/// Returns a unit vector without the symmetries of a mesh, so that it has a component along every eigenvector.
Vector start(Eigen::Index size) {
  Vector v(size);
  for (Eigen::Index i = 0; i < size; ++i) v[i] = std::fmod(double(i + 1) * 0.6180339887498949, 1.0) - 0.5;
  return v / v.norm();
}

}  // namespace

double spring_bound(std::size_t particles, std::span<const std::vector<Spring>* const> lists,
                    double Spring::*property) {
  constexpr Eigen::Index steps = 20;
  constexpr double reserve = 1.01;  // for eigenvalues so close to the largest that these steps do not tell them apart
  const Laplacian laplacian(particles, lists, property);
  const double most = laplacian.gershgorin();
  if (most <= 0) return 0;
  Vector diagonal(steps), beside(steps), before = Vector::Zero(Eigen::Index(particles)), v = start(before.size());
  Eigen::Index count = 0;
  while (count < steps && (count == 0 || beside[count - 1] > 1e-12 * most)) {
    Vector next = laplacian * v;
    diagonal[count] = v.dot(next);
    next -= diagonal[count] * v;
    if (count > 0) next -= beside[count - 1] * before;
    beside[count++] = next.norm();
    before = std::exchange(v, Vector(next / std::max(next.norm(), 1e-300)));
  }
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
  ritz.computeFromTridiagonal(diagonal.head(count), beside.head(count - 1));
  const double residual = beside[count - 1] * std::abs(ritz.eigenvectors()(count - 1, count - 1));
  return std::min(most, reserve * (ritz.eigenvalues()[count - 1] + residual));
}

}  // namespace softbody
