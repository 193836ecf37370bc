#include "softbody/integrate/implicit/quasi_newton.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "softbody/integrate/implicit/planes.h"
#include "softbody/state/best_rotation.h"

namespace softbody {
namespace {

constexpr int max_iterations = 40, iterations_of_round = 12;

/// Replaces the displacements (m) of held particles by the forces (N) that cause them, in the matrix's axes, by
/// Cholesky.
void find_forces(const ImplicitMatrix& matrix, std::span<const HeldEnd> held, std::span<glm::dvec3> moved) {
  const std::size_t axes = matrix.rotates() ? 3 : 1, size = axes * held.size();
  const auto compliance = [&](std::size_t row, std::size_t column) {
    const auto particle = [&](std::size_t i) { return Index(held[i / axes].at / implicit_lanes); };
    return matrix.compliance(particle(row), particle(column))[int(column % axes)][int(row % axes)];
  };
  std::vector<double> factor(size * size);
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double rest = compliance(i, j);
      for (std::size_t k = 0; k < j; ++k) rest -= factor[i * size + k] * factor[j * size + k];
      factor[i * size + j] = j < i ? rest / factor[j * size + j] : std::sqrt(std::max(rest, 1e-12 * compliance(i, i)));
    }
  for (int axis = 0; axis < 3; axis += int(axes)) {  // those that have no factor of their own one after another
    const auto at = [&](std::size_t i) -> double& { return moved[i / axes][axis + int(i % axes)]; };
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t k = 0; k < i; ++k) at(i) -= factor[i * size + k] * at(k);
      at(i) /= factor[i * size + i];
    }
    for (std::size_t i = size; i-- > 0;) {
      for (std::size_t k = i + 1; k < size; ++k) at(i) -= factor[k * size + i] * at(k);
      at(i) /= factor[i * size + i];
    }
  }
}

}  // namespace

QuasiNewton::QuasiNewton(const BodyModel& model)
    : kernels_(implicit_kernels()),
      forces_(implicit_force_kernels()),
      particles_(model.mesh.vertices.size()),
      stride_(particles_ * implicit_lanes),
      minimiser_(particles_) {
  for (Lanes* v : {&target_, &x_, &push_, &scratch_}) v->resize(3 * stride_);
}

/// Starts where the axes lead: what is stiff ends there but for little, and what is soft is there after one step.
void QuasiNewton::predict(const ImplicitProblem& p) {
  const ImplicitStart& s = p.start;
  for (std::size_t i = 0; i < 3 * stride_; ++i) target_[i] = s.x[i] + p.h * s.v[i] + p.h * p.h * s.a[i];
  x_ = s.x;
  stop_at_planes(p);
  for (const auto& [at, place] : s.held) write(x_, at, place);
  max_step_.fill(0);  // by a radius and the way to the target: the gradient is not usable farther out
  for (std::size_t i = 0; i < 3 * stride_; ++i)
    max_step_[i % implicit_lanes] += (target_[i] - x_[i]) * (target_[i] - x_[i]);
  for (double& r : max_step_) r = p.model.radius + std::sqrt(r / double(particles_));
}

/// Stops each body as a whole where its planes stop it. Behind them, it would start far inside the solid.
void QuasiNewton::stop_at_planes(const ImplicitProblem& p) {
  LaneMask any;
  for (const PlaneContact& c : p.planes) any.set(c.point.lane());
  for (std::size_t l = 0; l < implicit_lanes; ++l) {
    if (!any[l]) continue;
    glm::dvec3 meant(0.0);
    for (std::size_t i = l; i < stride_; i += implicit_lanes) meant += p.displacement(x_, i) / double(particles_);
    const auto aside = [&](std::size_t i) { return p.displacement(x_, i * implicit_lanes + l) - meant; };
    const glm::dvec3 less = stop_at(p.planes, l, p.h, meant, aside) - meant;
    for (std::size_t i = l; i < stride_; i += implicit_lanes) add(x_, i, less);
  }
}

/// Sets the rotation of the matrix to that of each body's shape as predicted.
void QuasiNewton::fit_rotation(const ImplicitProblem& p) {
  for (std::size_t l = 0; l < implicit_lanes; ++l) {
    const LaneView x{x_, l};
    glm::dmat3 covariance(0.0);
    for (std::size_t i = 0; i < particles_; ++i) covariance += glm::outerProduct(x(i) - x(0), p.matrix.shape()[i]);
    const glm::dmat3 r = best_rotation(covariance);
    for (int c = 0; c < 3; ++c)
      for (int row = 0; row < 3; ++row) rotation_[3 * c + row][l] = r[c][row];
  }
}

/// Sets g to the gradient at x: the mass times (x - target) / h^2, less the forces.
void QuasiNewton::gradient(const ImplicitProblem& p, const Lanes& x, Lanes& g) {
  std::fill(g.begin(), g.end(), 0.0);
  forces_.add({p.model, implicit_lanes, field(x), field(g)}, held_,
              {1 / p.h, field(p.start.x), field(p.start.carried), 1 / p.carry_time});
  add_contact_forces(p, x, g);
  const double inertia = p.model.particle_mass / (p.h * p.h);
  for (std::size_t i = 0; i < 3 * stride_; i += implicit_lanes)
    for (std::size_t l = 0; l < implicit_lanes; ++l)
      g[i + l] = double(p.start.moves[l]) * (inertia * (x[i + l] - target_[i + l]) - g[i + l]);
  for (const HeldEnd& held : p.start.held) write(g, held.at, glm::dvec3(0.0));
}

void QuasiNewton::add_contact_forces(const ImplicitProblem& p, const Lanes& x, Lanes& f) {
  constexpr double work_of_a_force = 1.0 / 32;  // of an iteration for one particle in all lanes, about
  work_ += double(p.planes.size() + p.penalty_pairs.size()) * work_of_a_force;
  for (const PlaneContact& c : p.planes)  // most of them are far off
    if (contact_.springs_lead() || c.force != glm::dvec3(0.0))
      c.point.add_to(f, contact_.force(p, c, p.displacement(x, c.point)));
  for (const LinearPenaltyPair& s : p.penalty_pairs) add(f, s.at, s.force_after(p.displacement(x, s.at)));
}

/// Sets q to A^-1 q for the particles that are free, and to 0 for held ones: what holds these adds to q such forces
/// that A^-1 moves them by nothing.
void QuasiNewton::apply_matrix(const ImplicitProblem& p, Lanes& q) {
  const std::vector<HeldEnd>& held = p.start.held;
  if (held.empty()) return apply_free_matrix(p, q);
  forces_on_free_ = q;
  apply_free_matrix(p, q);
  for (std::size_t first = 0, end = 0; first < held.size(); first = end) {
    const std::size_t lane = held[first].at % implicit_lanes;
    while (end < held.size() && held[end].at % implicit_lanes == lane) ++end;
    const std::span<const HeldEnd> own = std::span(held).subspan(first, end - first);
    std::vector<glm::dvec3> moved;
    const glm::dmat3 r = rotation(p, lane);
    for (const HeldEnd& one : own) moved.push_back(glm::transpose(r) * read(q, one.at));
    find_forces(p.matrix, own, moved);
    for (std::size_t i = 0; i < own.size(); ++i) add(forces_on_free_, own[i].at, -(r * moved[i]));
  }
  q = forces_on_free_;
  apply_free_matrix(p, q);
  for (const HeldEnd& one : held) write(q, one.at, glm::dvec3(0.0));
}

/// Sets q to A^-1 q.
void QuasiNewton::apply_free_matrix(const ImplicitProblem& p, Lanes& q) {
  if (!p.matrix.rotates()) {
    for (std::size_t k = 0; k < 3; ++k) kernels_.substitute(p.matrix.factor(), q.data() + k * stride_, scratch_.data());
    return;
  }
  kernels_.turn(particles_, rotation_, true, field(q));
  kernels_.substitute(p.matrix.factor(), q.data(), scratch_.data());
  // Loops do: these are four operations an unknown. The substitution takes over 100, by the entries of the factors of
  // spheres of 42 vertices, and more on finer ones.
  const std::vector<double>&gas = p.matrix.gas(), &response = p.matrix.gas_response();
  assert(gas.size() == response.size());
  PerLane along{};
  for (std::size_t i = 0; i < gas.size(); ++i)
    for (std::size_t l = 0; l < implicit_lanes; ++l) along[l] += gas[i] * q[i * implicit_lanes + l];
  for (double& a : along) a *= -p.matrix.gas_weight();
  for (std::size_t i = 0; i < response.size(); ++i)
    for (std::size_t l = 0; l < implicit_lanes; ++l) q[i * implicit_lanes + l] += response[i] * along[l];
  kernels_.turn(particles_, rotation_, false, field(q));
}

glm::dmat3 QuasiNewton::rotation(const ImplicitProblem& p, std::size_t lane) const {
  glm::dmat3 r(1.0);
  for (int c = 0; c < 3 && p.matrix.rotates(); ++c)
    for (int row = 0; row < 3; ++row) r[c][row] = rotation_[3 * c + row][lane];
  return r;
}

/// Moves x to where the forces are in balance with the contact forces as they are held. Returns true if all lanes have
/// converged.
bool QuasiNewton::minimise(const ImplicitProblem& p, int iterations) {
  const Objective objective{[&](const Lanes& x, Lanes& g) { gradient(p, x, g); },
                            [&](Lanes& q) { apply_matrix(p, q); }};
  return minimiser_.minimise(objective, x_, max_step_, 1e-9 * p.model.radius, iterations);
}

/// Brings the contact forces of the lanes up to date with the positions, and these with the forces' changes. Returns
/// how far (m) these have moved a point at most, or infinity where no forces are found.
PerLane QuasiNewton::update_contact_forces(const ImplicitProblem& p, LaneMask which) {
  PerLane moved{}, once;
  push_.assign(push_.size(), 0.0);
  for (std::size_t first = 0, end = 0; first < p.planes.size(); first = end) {
    const std::size_t lane = p.planes[first].point.lane();
    while (end < p.planes.size() && p.planes[end].point.lane() == lane) ++end;
    if (which[lane])
      moved[lane] = contact_.update(p, p.planes.subspan(first, end - first), x_, rotation(p, lane), push_);
  }
  if (std::ranges::max(moved) <= 0) return moved;
  apply_matrix(p, push_);
  once.fill(1.0);
  kernels_.add_scaled(3 * particles_, once.data(), push_.data(), x_.data());
  return moved;
}

/// Solves in rounds that each leave a fraction of the error where the matrix says what the body does. Returns the lanes
/// in which they have come to an end.
LaneMask QuasiNewton::solve_contact(const ImplicitProblem& p) {
  constexpr int max_rounds = 30, look_every = 2;
  constexpr double enough_progress = 0.25;  // of the moves are left: where it is more, the end would not be reached
  constexpr double anything = std::numeric_limits<double>::infinity();  // m
  const double enough = ContactForces::held_within * p.model.radius;
  contact_.start(false);
  LaneMask held, given_up;
  PerLane last;
  last.fill(anything);
  for (int round = 0; round < max_rounds && !(held | given_up).all(); ++round) {
    minimise(p, iterations_of_round);
    const PerLane moved = update_contact_forces(p, ~given_up);
    for (std::size_t l = 0; l < implicit_lanes; ++l) {
      held[l] = !given_up[l] && minimiser_.converged()[l] && moved[l] <= enough;
      const bool look = round % look_every == 0 && moved[l] > 0;
      const double less_than = look ? enough_progress * last[l] : anything;
      if (!(moved[l] <= enough) && !(moved[l] < less_than)) given_up.set(l);
      if (look) last[l] = moved[l];
    }
  }
  return held;
}

/// Solves robustly rather than exactly: forces and positions at the end need not be in balance.
void QuasiNewton::solve_contact_by_springs(const ImplicitProblem& p) {
  constexpr int max_rounds = 8;
  contact_.start(true);
  for (int round = 0; round < max_rounds; ++round) {
    update_contact_forces(p, LaneMask().set());
    const bool settled = minimise(p, iterations_of_round);
    double most = 0;
    for (PlaneContact& c : p.planes) {
      const glm::dvec3 force = contact_.force(p, c, p.displacement(x_, c.point));
      most = std::max(most, glm::length(force - c.force));
      c.force = force;
    }
    if (settled && most <= 1e-7 * p.model.radius * p.matrix.contact_stiffness()) break;
  }
}

const Lanes& QuasiNewton::solve(const ImplicitProblem& p) {
  minimiser_.forget();
  predict(p);
  if (p.matrix.rotates()) fit_rotation(p);
  forces_.hold({p.model, implicit_lanes, field(std::as_const(x_)), {}}, held_);
  if (p.planes.empty()) {
    minimise(p, max_iterations);
    return x_;
  }
  const LaneMask held = solve_contact(p);
  if (held.all()) return x_;
  const Lanes found = x_;
  const std::vector<PlaneContact> planes_before(p.planes.begin(), p.planes.end());
  for (PlaneContact& c : p.planes) c.force = glm::dvec3(0.0);
  predict(p);
  solve_contact_by_springs(p);
  for (std::size_t i = 0; i < found.size(); ++i)
    if (held[i % implicit_lanes]) x_[i] = found[i];
  for (std::size_t i = 0; i < planes_before.size(); ++i)
    if (held[planes_before[i].point.lane()]) p.planes[i] = planes_before[i];
  return x_;
}

}  // namespace softbody
