#include "softbody/state/best_rotation.h"

#include <array>
#include <cmath>

namespace softbody {
namespace {

using Matrix4 = std::array<std::array<double, 4>, 4>;

/// Applies one Jacobi rotation in the plane (p, q), after which a[p][q] of the symmetric matrix is 0. v accumulates the
/// rotations.
void rotate(Matrix4& a, Matrix4& v, std::size_t p, std::size_t q) {
  if (a[p][q] == 0) return;
  const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
  const double c = 1 / std::sqrt(t * t + 1), s = t * c;
  for (Matrix4* m : {&a, &v})
    for (auto& row : *m) {
      const double rp = row[p], rq = row[q];
      row[p] = c * rp - s * rq, row[q] = s * rp + c * rq;
    }
  for (std::size_t k = 0; k < 4; ++k) {
    const double pk = a[p][k], qk = a[q][k];
    a[p][k] = c * pk - s * qk, a[q][k] = s * pk + c * qk;
  }
}

/// Returns the eigenvector of the largest eigenvalue, by Jacobi's cyclic method. It uses no library function but sqrt,
/// so it gives the same bits everywhere.
std::array<double, 4> dominant_eigenvector(Matrix4 a) {
  Matrix4 v{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
  constexpr int sweeps = 12;  // far more than convergence takes, which is quadratic; a NaN ends here, too
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    double off = 0, on = 0;
    for (std::size_t p = 0; p < 4; ++p) {
      on += a[p][p] * a[p][p];
      for (std::size_t q = p + 1; q < 4; ++q) off += a[p][q] * a[p][q];
    }
    if (off <= 1e-30 * on) break;
    for (std::size_t p = 0; p < 4; ++p)
      for (std::size_t q = p + 1; q < 4; ++q) rotate(a, v, p, q);
  }
  std::size_t largest = 0;
  for (std::size_t k = 1; k < 4; ++k)
    if (a[k][k] > a[largest][largest]) largest = k;
  return {v[0][largest], v[1][largest], v[2][largest], v[3][largest]};
}

}  // namespace

glm::dmat3 best_rotation(const glm::dmat3& m) {
  const auto s = [&m](int from, int to) { return m[from][to]; };  // the sum of q_from x_to: a column belongs to a q
  const Matrix4 n{{{s(0, 0) + s(1, 1) + s(2, 2), s(1, 2) - s(2, 1), s(2, 0) - s(0, 2), s(0, 1) - s(1, 0)},
                   {s(1, 2) - s(2, 1), s(0, 0) - s(1, 1) - s(2, 2), s(0, 1) + s(1, 0), s(2, 0) + s(0, 2)},
                   {s(2, 0) - s(0, 2), s(0, 1) + s(1, 0), s(1, 1) - s(0, 0) - s(2, 2), s(1, 2) + s(2, 1)},
                   {s(0, 1) - s(1, 0), s(2, 0) + s(0, 2), s(1, 2) + s(2, 1), s(2, 2) - s(0, 0) - s(1, 1)}}};
  const auto [w, x, y, z] = dominant_eigenvector(n);
  const double two = 2 / (w * w + x * x + y * y + z * z);  // of a unit quaternion 2
  return {glm::dvec3(1 - two * (y * y + z * z), two * (x * y + w * z), two * (x * z - w * y)),
          glm::dvec3(two * (x * y - w * z), 1 - two * (x * x + z * z), two * (y * z + w * x)),
          glm::dvec3(two * (x * z + w * y), two * (y * z - w * x), 1 - two * (x * x + y * y))};
}

}  // namespace softbody
