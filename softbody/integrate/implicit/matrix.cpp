#include "softbody/integrate/implicit/matrix.h"

#include <algorithm>
#include <mutex>
#include <numeric>

#include <Eigen/SparseCholesky>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "softbody/mechanics/make_body_model.h"
#include "softbody/mechanics/visit.h"
#include "softbody/model/scene_error.h"

namespace softbody {
namespace {

// The sparse solver adds one number after another. Dense vectors of Eigen add as many at a time as a register holds, so
// no sum that has to be the same everywhere is theirs.
using Sparse = Eigen::SparseMatrix<double>;
using Entries = std::vector<Eigen::Triplet<double>>;

using Shape = std::vector<glm::dvec3>;

/// How forces across the directions of pairs and the volume's across its faces enter: as they are, or only where they
/// are sure to leave the matrix positive definite.
enum class Tension { exact, pulling };

/// Returns the shape in which the body is in balance, or its starting shape if none is found.
Shape balanced_shape(const BodyModel& model) {
  if (model.forces->pressure <= 0) return model.start;
  try {
    return find_equilibrium(model, model.start);
  } catch (const SceneError&) {
    return model.start;
  }
}

/// What the forces inside a body at x add to the matrix, but for how the pull of the volume changes with it: see
/// volume_pull().
struct Assemble {
  const BodyModel& model;
  const Shape& x;
  double h;
  bool rotates;
  Tension tension;
  Entries& entries;

  int count() const { return int(x.size()); }

  void operator()(Length c, const auto& law) const {
    const glm::dmat3 b = block(c, law);
    const int n = count(), axes = rotates ? 3 : 1, i = int(c.i), j = int(c.j);
    for (int row = 0; row < axes; ++row)
      for (int column = 0; column < axes; ++column) {
        entries.emplace_back(row * n + i, column * n + i, b[column][row]);
        entries.emplace_back(row * n + j, column * n + j, b[column][row]);
        entries.emplace_back(row * n + i, column * n + j, -b[column][row]);
        entries.emplace_back(row * n + j, column * n + i, -b[column][row]);
      }
  }
  /// Returns what stands on the diagonal of the two particles; beside the diagonal it is subtracted.
  glm::dmat3 block(Length c, const auto& law) const {
    const glm::dvec3 d = x[c.j] - x[c.i];
    const double length = glm::length(d);
    const Jet pull = pull_at(law, Jet(length, 1));
    const double along = pull.slope + law.damping / h;
    if (!rotates || length <= 0) return glm::dmat3(along);
    const glm::dmat3 direction = glm::outerProduct(d / length, d / length);
    const double across = pull.value / length;
    return along * direction +
           (tension == Tension::exact ? across : std::max(0.0, across)) * (glm::dmat3(1) - direction);
  }

  /// pull d2V/dx2: a corner's gradient is a sixth of the cross product of the two others.
  void operator()(Volume, const auto& law) const {
    if (tension != Tension::exact) return;
    const int n = count();
    const double sixth = -law.pull(volume(x, model.mesh.triangles)) / 6;
    for (const auto& triangle : model.mesh.triangles)
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const int a = int(triangle[corner]), b = int(triangle[(corner + 1) % 3]);
        const glm::dvec3 c = sixth * x[triangle[(corner + 2) % 3]];
        for (int r = 0; r < 3; ++r) {  // the matrix of v -> c x v, and its transpose
          const int s = (r + 1) % 3, t = (r + 2) % 3;
          entries.emplace_back(r * n + a, s * n + b, -c[t]);
          entries.emplace_back(s * n + b, r * n + a, -c[t]);
          entries.emplace_back(r * n + a, t * n + b, c[s]);
          entries.emplace_back(t * n + b, r * n + a, c[s]);
        }
      }
  }

  void operator()(Offset c, const simd::Vec<double>&, const auto& law) const { add_to_diagonal(c.i, law.stiffness); }
  void operator()(Path c, const auto& law) const { add_to_diagonal(c.i, law.damping / h); }
  void add_to_diagonal(Index i, double value) const {
    for (int axis = 0; axis < (rotates ? 3 : 1); ++axis) {
      const int unknown = axis * count() + int(i);
      entries.emplace_back(unknown, unknown, value);
    }
  }
};

Sparse assemble(const BodyModel& model, const Shape& x, double h, bool rotates, Tension tension) {
  const int n = int(x.size()), axes = rotates ? 3 : 1;
  Entries entries;
  std::array<std::vector<double>, 3> component;
  for (int k = 0; k < 3; ++k)
    for (const glm::dvec3& place : x) component[std::size_t(k)].push_back(place[k]);
  visit_all(model, {component[0].data(), component[1].data(), component[2].data()},
            Assemble{model, x, h, rotates, tension, entries});
  for (int i = 0; i < axes * n; ++i) entries.emplace_back(i, i, model.particle_mass / (h * h));
  Sparse a(axes * n, axes * n);
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

/// Returns true if column c + 1 has entries in the same rows as column c, but for its own.
bool goes_on(const Sparse& l, Eigen::Index c) {
  const auto* rows = l.innerIndexPtr();
  const auto first = l.outerIndexPtr()[c], next = l.outerIndexPtr()[c + 1], end = l.outerIndexPtr()[c + 2];
  return next - first == end - next + 1 && std::equal(rows + first + 1, rows + next, rows + next);
}

/// Adds the columns `first` to end - 1 as one supernode. `l`: columns in order of their rows, each with its diagonal
/// first.
void copy_run(const Sparse& l, Eigen::Index first, Eigen::Index end, CholeskyFactor& f) {
  const auto *start = l.outerIndexPtr(), *rows = l.innerIndexPtr();
  const auto w = std::size_t(end - first), all = std::size_t(start[first + 1] - start[first]);
  f.supernodes.push_back(
      {std::uint32_t(first), std::uint32_t(w), std::uint32_t(f.row.size()), std::uint32_t(all - w), f.value.size()});
  f.row.insert(f.row.end(), rows + start[first] + w, rows + start[first + 1]);
  f.value.resize(f.value.size() + all * w);
  double* value = f.value.data() + f.supernodes.back().value;
  for (std::size_t c = 0; c < w; ++c) {
    const double* column = l.valuePtr() + start[first + Eigen::Index(c)];
    value[c * w + c] = 1 / column[0];
    for (std::size_t r = c + 1; r < all; ++r) value[r * w + c] = column[r - c];
  }
}

CholeskyFactor copy(const Eigen::SimplicialLLT<Sparse>& llt) {
  CholeskyFactor f;
  Sparse l = llt.matrixL();
  l.makeCompressed();
  for (Eigen::Index i = 0; i < l.cols(); ++i) f.place.push_back(std::uint32_t(llt.permutationP().indices()[i]));
  for (Eigen::Index first = 0, c = 0; c < l.cols(); ++c) {
    if (c + 1 < l.cols() && goes_on(l, c)) continue;
    copy_run(l, first, c + 1, f);
    first = c + 1;
  }
  return f;
}

/// Returns dV/dx.
Eigen::VectorXd volume_gradient(const BodyModel& model, const Shape& x) {
  const auto n = Eigen::Index(model.mesh.vertices.size());
  Eigen::VectorXd g = Eigen::VectorXd::Zero(3 * n);
  for (const auto& [i, j, k] : model.mesh.triangles) {
    const glm::dvec3 sixth = glm::cross(x[j] - x[i], x[k] - x[i]) / 6.0;
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

ImplicitMatrix::ImplicitMatrix(const BodyModel& model, double h, const ImplicitMatrix* other)
    : rotates_(model.mesh.closed),
      balanced_(other ? other->balanced_ : std::make_shared<const Shape>(balanced_shape(model))),
      factored_(std::make_unique<Factored>()) {
  const Shape& x = *balanced_;
  for (const Tension tension : {Tension::exact, Tension::pulling}) {
    Sparse a = assemble(model, x, h, rotates_, tension);
    // So little mass that rounding hides it: directions need not be that exact.
    if (tension == Tension::pulling) a.diagonal().array() += 1e-12 * a.diagonal().maxCoeff();
    // A body's own springs set the scale, but as a whole it has to feel no more than the solver can bring to rest.
    const Eigen::VectorXd diagonal = a.diagonal();
    const double mean = std::accumulate(diagonal.begin(), diagonal.end(), 0.0) / double(diagonal.size());
    contact_stiffness_ = std::min(2 * mean, 1000 * model.material[Material::mass] / (h * h));
    factored_->llt.compute(a);
    if (factored_->llt.info() == Eigen::Success) break;
  }
  if (factored_->llt.info() != Eigen::Success)
    throw SceneError("material '" + model.material.name +
                     "': its stiffness, damping and mass make no matrix that can be " +
                     "factored; use values closer to one another");
  factor_ = copy(factored_->llt);
  factored_->once = std::vector<std::once_flag>(x.size());
  factored_->columns.resize(x.size());
  glm::dvec3 mean(0.0);
  for (const glm::dvec3& place : x) mean += place / double(x.size());
  for (const glm::dvec3& place : x) shape_.push_back(place - mean);
  if (model.forces->pressure <= 0 || !rotates_) return;
  const Eigen::VectorXd g = volume_gradient(model, x), response = factored_->llt.solve(g);
  const double slope = volume_pull(model, volume(x, model.mesh.triangles)).slope;
  gas_.assign(g.begin(), g.end());
  gas_response_.assign(response.begin(), response.end());
  gas_weight_ = slope / (1 + slope * std::inner_product(g.begin(), g.end(), response.begin(), 0.0));
}

ImplicitMatrix::~ImplicitMatrix() = default;

void ImplicitMatrix::solve_columns(Index j) const {
  const std::size_t n = shape_.size(), axes = rotates_ ? 3 : 1;
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
  if (!rotates_) return glm::dmat3(column[i]);
  const std::size_t n = shape_.size();
  glm::dmat3 block;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t r = 0; r < 3; ++r) block[int(c)][int(r)] = column[c * 3 * n + r * n + i];
  return block;
}

}  // namespace softbody
