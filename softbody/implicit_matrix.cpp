#include "softbody/implicit_matrix.h"

#include <algorithm>
#include <mutex>

#include <Eigen/SparseCholesky>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "softbody/shape_matching.h"

namespace softbody {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Entries = std::vector<Eigen::Triplet<double>>;

/// What a spring adds to the diagonal of its two particles, and takes from beside it.
glm::dmat3 block(const Prototype& p, const Spring& s, double h, bool turns) {
  const double along = s.stiffness + s.damping / h;
  const glm::dvec3 d = p.start[s.j] - p.start[s.i];
  const double length = glm::length(d);
  if (!turns || length <= 0) return glm::dmat3(along);
  const glm::dmat3 direction = glm::outerProduct(d / length, d / length);
  return along * direction + s.stiffness * std::max(0.0, 1 - s.rest / length) * (glm::dmat3(1) - direction);
}

Sparse assemble(const Prototype& p, double h, bool turns) {
  const int n = int(p.mesh.vertices.size()), axes = turns ? 3 : 1;
  Entries entries;
  for (const auto* list : {&p.structural, &p.bend, &p.shear})
    for (const Spring& s : *list) {
      const glm::dmat3 b = block(p, s, h, turns);
      for (int r = 0; r < axes; ++r)
        for (int c = 0; c < axes; ++c) {
          const int i = int(s.i), j = int(s.j);
          entries.emplace_back(r * n + i, c * n + i, b[c][r]);
          entries.emplace_back(r * n + j, c * n + j, b[c][r]);
          entries.emplace_back(r * n + i, c * n + j, -b[c][r]);
          entries.emplace_back(r * n + j, c * n + i, -b[c][r]);
        }
    }
  for (int i = 0; i < axes * n; ++i) entries.emplace_back(i, i, p.particle_mass / (h * h) + shape_stiffness(p));
  Sparse a(axes * n, axes * n);
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

CholeskyFactor copy(const Eigen::SimplicialLLT<Sparse>& llt) {
  CholeskyFactor f;
  const Sparse l = llt.matrixL();
  for (Eigen::Index i = 0; i < l.cols(); ++i)
    f.place.push_back(static_cast<std::uint32_t>(llt.permutationP().indices()[i]));
  f.first.push_back(0);
  for (Eigen::Index c = 0; c < l.cols(); ++c) {
    for (Sparse::InnerIterator entry(l, c); entry; ++entry) {
      if (entry.row() == c) {
        f.inverse_diagonal.push_back(1 / entry.value());
        continue;
      }
      f.row.push_back(static_cast<std::uint32_t>(entry.row()));
      f.value.push_back(entry.value());
    }
    f.first.push_back(static_cast<std::uint32_t>(f.row.size()));
  }
  return f;
}

/// dV/dx at the starting shape.
Eigen::VectorXd volume_gradient(const Prototype& p) {
  const auto n = static_cast<Eigen::Index>(p.mesh.vertices.size());
  Eigen::VectorXd g = Eigen::VectorXd::Zero(3 * n);
  for (const auto& [i, j, k] : p.mesh.triangles) {
    const glm::dvec3 sixth = glm::cross(p.start[j] - p.start[i], p.start[k] - p.start[i]) / 6.0;
    for (const Index corner : {i, j, k})
      for (int axis = 0; axis < 3; ++axis) g[axis * n + Eigen::Index(corner)] += sixth[axis];
  }
  return g;
}

}  // namespace

/// The factor as the library has it, and the columns of the inverse that were asked for.
struct ImplicitMatrix::Factored {
  Eigen::SimplicialLLT<Sparse> llt;
  std::vector<std::once_flag> once;
  std::vector<std::vector<double>> columns;  // of particle j: its three columns, or its one
};

ImplicitMatrix::ImplicitMatrix(const Prototype& p, double h)
    : turns_(p.mesh.closed), factored_(std::make_unique<Factored>()) {
  const Sparse a = assemble(p, h, turns_);
  // A body's own springs set the scale, but as a whole it has to feel no more than the solver can bring to rest.
  contact_stiffness_ = std::min(2 * a.diagonal().mean(), 1000 * p.material.mass / (h * h));
  factored_->llt.compute(a);
  if (factored_->llt.info() != Eigen::Success)
    throw SceneError("material '" + p.material.name + "': its stiffness, damping and mass make no matrix that can be " +
                     "factored; use values closer to one another");
  factor_ = copy(factored_->llt);
  factored_->once = std::vector<std::once_flag>(p.start.size());
  factored_->columns.resize(p.start.size());
  glm::dvec3 mean(0.0);
  for (const glm::dvec3& x : p.start) mean += x / double(p.start.size());
  for (const glm::dvec3& x : p.start) shape_.push_back(x - mean);
  if (!p.has_gas || !turns_) return;
  const Eigen::VectorXd g = volume_gradient(p), response = factored_->llt.solve(g);
  const double slope = -p.gas.slope(p.start_volume);
  gas_.assign(g.begin(), g.end());
  gas_response_.assign(response.begin(), response.end());
  gas_weight_ = slope / (1 + slope * g.dot(response));
}

ImplicitMatrix::~ImplicitMatrix() = default;

void ImplicitMatrix::solve_columns(Index j) const {
  const std::size_t n = shape_.size(), axes = turns_ ? 3 : 1;
  std::vector<double> columns;
  for (std::size_t axis = 0; axis < axes; ++axis) {
    const std::size_t unknown = axis * n + j;
    Eigen::VectorXd column = Eigen::VectorXd::Unit(Eigen::Index(axes * n), Eigen::Index(unknown));
    column = factored_->llt.solve(column).eval();
    for (std::size_t i = 0; i < gas_.size(); ++i)
      column[Eigen::Index(i)] -= gas_weight_ * gas_response_[unknown] * gas_response_[i];
    columns.insert(columns.end(), column.begin(), column.end());
  }
  factored_->columns[j] = std::move(columns);
}

glm::dmat3 ImplicitMatrix::compliance(Index i, Index j) const {
  std::call_once(factored_->once[j], [&] { solve_columns(j); });
  const std::vector<double>& column = factored_->columns[j];
  if (!turns_) return glm::dmat3(column[i]);
  const std::size_t n = shape_.size();
  glm::dmat3 block;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t r = 0; r < 3; ++r) block[int(c)][int(r)] = column[c * 3 * n + r * n + i];
  return block;
}

}  // namespace softbody
