#include "softbody/mechanics/bound.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/Eigenvalues>
#include <glm/geometric.hpp>

#include "softbody/mechanics/visit.h"

namespace softbody {
namespace {

// Eigen's own sums depend on how many numbers a register holds; what it does here element by element does not.
using Vector = Eigen::VectorXd;
double dot(const Vector& a, const Vector& b) { return std::inner_product(a.begin(), a.end(), b.begin(), 0.0); }
double norm(const Vector& v) { return std::sqrt(dot(v, v)); }

class Laplacian {
 public:
  Laplacian(std::size_t particles, std::span<const WeightedPair> pairs)
      : pairs_(pairs), sum_(Vector::Zero(Eigen::Index(particles))) {
    for (const auto& [i, j, weight] : pairs_)
      for (const Index end : {i, j}) sum_[end] += weight;
  }

  double gershgorin() const { return 2 * sum_.maxCoeff(); }

  Vector operator*(const Vector& v) const {
    Vector result = sum_.cwiseProduct(v);
    for (const auto& [i, j, weight] : pairs_) {
      result[i] -= weight * v[j];
      result[j] -= weight * v[i];
    }
    return result;
  }

 private:
  std::span<const WeightedPair> pairs_;
  Vector sum_;
};

/// Returns a unit vector without the symmetries of a mesh, so that it has a component along every eigenvector.
Vector start(Eigen::Index size, bool squares) {
  Vector v(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const auto number = double(i + 1);
    v[i] = std::fmod((squares ? number * number : number) * 0.6180339887498949, 1.0) - 0.5;
  }
  return v / norm(v);
}

struct LargestEigenvalue {
  double bound;
  bool ended;  // where a few of the eigenvectors, those that v has a part of, are all that is seen
};

/// Finds the largest eigenvalue by Lanczos' method from v.
LargestEigenvalue largest_eigenvalue(const Laplacian& laplacian, Vector v) {
  constexpr Eigen::Index steps = 20;
  constexpr double reserve = 1.01;  // for eigenvalues so close to the largest that these steps do not tell them apart
  const double most = laplacian.gershgorin();
  Vector diagonal(steps), beside(steps), before = Vector::Zero(v.size());
  Eigen::Index count = 0;
  while (count < steps && (count == 0 || beside[count - 1] > 1e-12 * most)) {
    Vector next = laplacian * v;
    diagonal[count] = dot(v, next);
    next -= diagonal[count] * v;
    if (count > 0) next -= beside[count - 1] * before;
    const double length = beside[count++] = norm(next);
    before = std::exchange(v, Vector(next / std::max(length, 1e-300)));
  }
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
  ritz.computeFromTridiagonal(diagonal.head(count), beside.head(count - 1));
  const double residual = beside[count - 1] * std::abs(ritz.eigenvectors()(count - 1, count - 1));
  return {std::min(most, reserve * (ritz.eigenvalues()[count - 1] + residual)), count < steps};
}

}  // namespace

double pair_bound(std::size_t particles, std::span<const WeightedPair> pairs) {
  assert(std::ranges::all_of(pairs, [&](const WeightedPair& p) { return p.i < particles && p.j < particles; }));
  const Laplacian laplacian(particles, pairs);
  if (laplacian.gershgorin() <= 0) return 0;
  const LargestEigenvalue first = largest_eigenvalue(laplacian, start(Eigen::Index(particles), false));
  if (!first.ended) return first.bound;
  return std::max(first.bound, largest_eigenvalue(laplacian, start(Eigen::Index(particles), true)).bound);
}

void set_bounds(ModelForces& all, std::size_t particles) {
  std::vector<WeightedPair> stiffness, damping;
  for_each_force(Forces{}, [&]<class F>(Name<F>) {
    if constexpr (HasElements<F>) {
      const auto& own = all.of<F>();
      if (!own) return;
      if constexpr (F::coordinate == Coordinate::length)
        for (const auto& law : own->template elements<double>()) {
          stiffness.push_back({law.i, law.j, law.stiffness});
          damping.push_back({law.i, law.j, law.damping});
        }
      if constexpr (F::coordinate == Coordinate::volume) all.pressure += own->scale();
      if constexpr (F::coordinate == Coordinate::offset) all.offset_stiffness += own->stiffness / 2;
      if constexpr (F::coordinate == Coordinate::path) all.path_damping += own->damping / 2;
    }
  });
  all.pair_stiffness = pair_bound(particles, stiffness) / 2;
  all.pair_damping = pair_bound(particles, damping) / 2;
}

double damping_bound(const BodyModel& model) { return model.forces->pair_damping + model.forces->path_damping; }

double stable_step(double k_m, double c_m) {
  // Twice the sum of a row bounds a spring matrix: each spring stands on its diagonal and beside it (Gershgorin).
  const double omega2 = 2 * k_m, gamma = 2 * c_m;
  if (omega2 <= 0) return gamma > 0 ? 0.8 * 2 / gamma : 1e9;
  const double omega = std::sqrt(omega2), z = gamma / (2 * omega);
  return 0.8 * (2 / omega) / (std::sqrt(1 + z * z) + z);  // sqrt(1 + z^2) - z, but exact for large z too
}

double stiffness_per_mass(const BodyModel& model, const SurfaceShape& surface, Volumes volumes) {
  const ModelForces& f = *model.forces;
  const double others = f.pair_stiffness / model.particle_mass + f.offset_stiffness / model.particle_mass;
  if (f.pressure <= 0) return others;
  // Gas: F_i = P A_i with the gauge pressure P, A_i = dV/dx_i. Its matrix is -dP/dV A A^T, of norm s = -dP/dV sum
  // |A_i|^2, plus P d2V/dx2. Breathing, which the first is about, hardly stretches pairs: L being their Laplacian, l
  // its bound and a = A / |A|, q = a^T L a is far below l. An eigenvalue x > l of L + s a a^T has
  // 1 = s a^T (x - L)^-1 a <= s ((1 - q/l) / x + (q/l) / (x - l)), for 1 / (x - y) is convex in y, and so is at most
  // the larger root of x^2 - (l + s) x + s (l - q). In the second part, particles i and j of an edge are joined by a
  // sixth of the line between the two corners opposite, which is at most the medians from there to the edge together:
  // a row is at most two medians a face at i.
  const Jet pull = volume_pull(model, surface.volume);
  const double l = 2 * f.pair_stiffness, s = pull.slope * surface.area2;
  const double q = surface.area2 > 0 ? std::min(l, surface.stretch / surface.area2) : 0;
  const double both = (l + s) / 2 + std::sqrt((l - s) * (l - s) / 4 + s * q);
  const double turned = std::abs(pull.value) * model.largest_degree * surface.two_medians / 6;
  return others + (turned + (volumes == Volumes::explicit_ ? both - l : 0)) / (2 * model.particle_mass);
}

SurfaceShape measure_surface(const BodyModel& model, const std::vector<glm::dvec3>& vertices) {
  if (model.forces->pressure <= 0) return {};
  SurfaceShape s{.volume = volume(vertices, model.mesh.triangles)};
  std::vector<glm::dvec3> area(vertices.size(), glm::dvec3(0));
  for (const auto& [i, j, k] : model.mesh.triangles) {
    const glm::dvec3 a = vertices[i], b = vertices[j], c = vertices[k], third = glm::cross(b - a, c - a) / 6.0;
    for (const Index corner : {i, j, k}) area[corner] += third;
    const auto square = [](const glm::dvec3& v) { return glm::dot(v, v); };
    const double of_a = square(a - (b + c) / 2.0), of_b = square(b - (c + a) / 2.0), of_c = square(c - (a + b) / 2.0);
    s.two_medians = std::max(s.two_medians, std::sqrt(2 * std::max({of_a + of_b, of_b + of_c, of_c + of_a})));
  }
  for (const glm::dvec3& a : area) s.area2 += glm::dot(a, a);
  visit_forces<Coordinate::length>(model, {}, [&](Length c, const auto& law) {
    const glm::dvec3 d = area[c.i] - area[c.j];
    s.stretch += law.stiffness * glm::dot(d, d);
  });
  return s;
}

}  // namespace softbody
