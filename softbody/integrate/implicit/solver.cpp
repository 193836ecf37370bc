#include "softbody/integrate/implicit/solver.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "softbody/contact/law.h"
#include "softbody/forces/best_rotation.h"

namespace softbody {

ImplicitSolver::ImplicitSolver(const BodyModel& p, const ImplicitKernels& kernels)
    : kernels_(kernels),
      forces_(implicit_force_kernels(kernels.isa)),
      particles_(p.mesh.vertices.size()),
      stride_(particles_ * lanes) {
  for (Lanes* v : {&target_, &x_, &trial_, &gradient_, &trial_gradient_, &direction_, &scratch_})
    v->resize(3 * stride_);
  for (auto* list : {&steps_, &changes_})
    for (Lanes& v : *list) v.resize(3 * stride_);
}

ImplicitWork::ImplicitWork(const BodyModel& model, const ImplicitKernels& kernels) : solver(model, kernels) {
  for (Lanes* lane_field : {&x, &v, &end_v, &stage_x, &stage_v, &a, &stage_a, &frame_displacement})
    lane_field->resize(3 * model.mesh.vertices.size() * lanes);
}

ImplicitSolver::PerLane ImplicitSolver::product(const Lanes& a, const Lanes& b) const {
  PerLane result;
  kernels_.inner_product(3 * particles_, a.data(), b.data(), result.data());
  return result;
}

void ImplicitSolver::add_scaled(const PerLane& times, const Lanes& a, Lanes& y) const {
  kernels_.add_scaled(3 * particles_, times.data(), a.data(), y.data());
}

/// Where the frame leads: what is stiff ends there but for little, and what is soft is there after one step.
void ImplicitSolver::predict(const ImplicitProblem& p) {
  for (std::size_t i = 0; i < 3 * stride_; ++i) target_[i] = (*p.x)[i] + p.h * (*p.v)[i] + p.h * p.h * (*p.a)[i];
  x_ = *p.x;
  stop_at_planes(p);
  max_step_.fill(0);
  for (std::size_t i = 0; i < 3 * stride_; ++i) max_step_[i % lanes] += (target_[i] - x_[i]) * (target_[i] - x_[i]);
  for (double& r : max_step_) r = p.model.radius + std::sqrt(r / double(particles_));
}

void ImplicitSolver::fit_rotation(const ImplicitProblem& p) {
  for (std::size_t l = 0; l < lanes; ++l) {
    const LaneView x{x_, l};
    glm::dmat3 covariance(0.0);
    for (std::size_t i = 0; i < particles_; ++i) covariance += glm::outerProduct(x(i) - x(0), p.matrix.shape()[i]);
    const glm::dmat3 r = best_rotation(covariance);
    for (int c = 0; c < 3; ++c)
      for (int row = 0; row < 3; ++row) rotation_[3 * c + row][l] = r[c][row];
  }
}

void ImplicitSolver::gradient(const ImplicitProblem& p, const Lanes& x, Lanes& g) {
  std::fill(g.begin(), g.end(), 0.0);
  forces_.add({p.model, lanes, field(x), field(g)}, held_, {1 / p.h, field(*p.x), field(*p.frame_displacement)});
  add_contact_forces(p, x, g);
  const double inertia = p.model.particle_mass / (p.h * p.h);
  for (std::size_t i = 0; i < 3 * stride_; i += lanes)
    for (std::size_t l = 0; l < lanes; ++l)
      g[i + l] = double(p.moves[l]) * (inertia * (x[i + l] - target_[i + l]) - g[i + l]);
}

void ImplicitSolver::add_contact_forces(const ImplicitProblem& p, const Lanes& x, Lanes& f) {
  constexpr double work_of_a_force = 1.0 / 32;  // of an iteration for one particle in all lanes, about
  work_ += double(p.planes->size() + p.penalty_pairs->size()) * work_of_a_force;
  for (const PlaneContact& c : *p.planes) add(f, c.at, contact_force(p, c, moved(p, x, c.at)));
  for (const LinearPenaltyPair& s : *p.penalty_pairs) add(f, s.at, s.force_after(moved(p, x, s.at)));
}

glm::dvec3 LinearPenaltyPair::force_after(const glm::dvec3& moved) const {
  const glm::dvec3 apart = moved - partner, faster = apart - start_separation;
  const double push = glm::dot(force, normal);
  const double press = std::max(
      0.0, push - double(slopes.spring) * glm::dot(apart, normal) - double(slopes.damper) * glm::dot(faster, normal));
  const auto across = [this](const glm::dvec3& v) { return v - glm::dot(v, normal) * normal; };
  // The friction spring of the start has slipped for this step already, see PenaltyContact::evaluate().
  const glm::dvec3 drag = across(force) - double(slopes.across_spring + slopes.across_damper) * across(faster);
  return press * normal + law::within_cone(drag, friction * press);
}

/// q = A^-1 q
void ImplicitSolver::apply_matrix(const ImplicitProblem& p, Lanes& q) {
  if (!p.matrix.rotates()) {
    for (std::size_t k = 0; k < 3; ++k) kernels_.substitute(p.matrix.factor(), q.data() + k * stride_, scratch_.data());
    return;
  }
  kernels_.turn(particles_, rotation_, true, field(q));
  kernels_.substitute(p.matrix.factor(), q.data(), scratch_.data());
  if (!p.matrix.gas().empty()) {
    PerLane along;
    kernels_.inner_product_shared(3 * particles_, p.matrix.gas().data(), q.data(), along.data());
    for (double& a : along) a *= -p.matrix.gas_weight();
    kernels_.add_scaled_shared(3 * particles_, along.data(), p.matrix.gas_response().data(), q.data());
  }
  kernels_.turn(particles_, rotation_, false, field(q));
}

/// Nocedal's two loops (1980): direction = -H gradient.
void ImplicitSolver::direction(const ImplicitProblem& p) {
  std::array<PerLane, history> weight;
  direction_ = gradient_;
  const auto back = [this](std::size_t age) { return (newest_ + history - age) % history; };
  for (std::size_t age = 0; age < remembered_; ++age) {
    const std::size_t i = back(age);
    weight[i] = product(steps_[i], direction_);
    PerLane less;
    for (std::size_t l = 0; l < lanes; ++l) less[l] = -(weight[i][l] *= curvature_[i][l]);
    add_scaled(less, changes_[i], direction_);
  }
  apply_matrix(p, direction_);
  for (std::size_t age = remembered_; age-- > 0;) {
    const std::size_t i = back(age);
    PerLane more = product(changes_[i], direction_);
    for (std::size_t l = 0; l < lanes; ++l) more[l] = weight[i][l] - curvature_[i][l] * more[l];
    add_scaled(more, steps_[i], direction_);
  }
  for (double& d : direction_) d = -d;
}

/// trial = x + step * direction and its gradient, the step so short that the slope has not turned steeply upwards.
void ImplicitSolver::line_search(const ImplicitProblem& p) {
  const PerLane slope = product(gradient_, direction_), length2 = product(direction_, direction_);
  for (std::size_t l = 0; l < lanes; ++l) {
    // No particle is to leap over its body: beyond lie other slopes. A slope upwards: at the minimum, or lost. What has
    // converged stays, whatever the others in the batch still need.
    step_[l] = std::min(1.0, max_step_[l] / std::sqrt(length2[l] / double(particles_)));
    if (!(slope[l] < 0) || !std::isfinite(slope[l]) || converged_[l]) step_[l] = 0;
  }
  for (int halving = 0;; ++halving) {
    trial_ = x_;
    add_scaled(step_, direction_, trial_);
    gradient(p, trial_, trial_gradient_);
    const PerLane end = product(trial_gradient_, direction_);
    bool all = true;
    for (std::size_t l = 0; l < lanes; ++l) {
      if (step_[l] <= 0 || end[l] <= -0.9 * slope[l]) continue;
      const double secant = slope[l] / (slope[l] - end[l]);
      step_[l] *= std::isfinite(secant) ? std::clamp(secant, 0.1, 0.6) : 0.1;
      all = false;
    }
    if (!all && halving < max_halvings) continue;
    for (std::size_t l = 0; l < lanes; ++l)
      if (!std::isfinite(end[l])) stay(l);
    return;
  }
}

/// No step in a lane whose direction leads out of the numbers.
void ImplicitSolver::stay(std::size_t lane) {
  for (std::size_t i = lane; i < 3 * stride_; i += lanes) {
    trial_[i] = x_[i];
    trial_gradient_[i] = gradient_[i];
  }
}

/// The step just found joins the history; where it saw no curvature it has no say.
void ImplicitSolver::remember() {
  newest_ = (newest_ + 1) % history;
  remembered_ = std::min(remembered_ + 1, history);
  Lanes &s = steps_[newest_], &y = changes_[newest_];
  for (std::size_t i = 0; i < 3 * stride_; ++i) {
    s[i] = trial_[i] - x_[i];
    y[i] = trial_gradient_[i] - gradient_[i];
  }
  const PerLane sy = product(s, y), yy = product(y, y), ss = product(s, s);
  for (std::size_t l = 0; l < lanes; ++l)
    curvature_[newest_][l] = sy[l] > 1e-10 * std::sqrt(ss[l] * yy[l]) ? 1 / sy[l] : 0;
}

/// Whether all lanes have converged.
bool ImplicitSolver::minimise(const ImplicitProblem& p, int iterations) {
  const double enough = 1e-9 * p.model.radius;
  gradient(p, x_, gradient_);
  converged_.fill(false);
  for (int i = 0; i < iterations; ++i) {
    work_ += double(particles_);
    direction(p);
    line_search(p);
    remember();
    std::swap(x_, trial_);
    std::swap(gradient_, trial_gradient_);
    const PerLane square = product(steps_[newest_], steps_[newest_]);
    bool all = true;
    for (std::size_t l = 0; l < lanes; ++l) {
      converged_[l] = square[l] <= enough * enough * double(particles_);
      all = all && converged_[l];
    }
    if (all) return true;
  }
  return false;
}

const Lanes& ImplicitSolver::solve(const ImplicitProblem& p) {
  remembered_ = 0;
  predict(p);
  if (p.matrix.rotates()) fit_rotation(p);
  forces_.hold({p.model, lanes, field(std::as_const(x_)), {}}, held_);
  if (p.planes->empty()) {
    minimise(p, max_iterations);
    return x_;
  }
  const std::array<bool, lanes> held = solve_contact_forces(p);
  if (std::ranges::find(held, false) == held.end()) return x_;
  const Lanes found = x_;
  const std::vector<PlaneContact> planes_before = *p.planes;
  for (PlaneContact& c : *p.planes) c.force = glm::dvec3(0.0);
  predict(p);
  solve_penalty(p);
  for (std::size_t i = 0; i < found.size(); ++i)
    if (held[i % lanes]) x_[i] = found[i];
  for (std::size_t i = 0; i < planes_before.size(); ++i)
    if (held[planes_before[i].at % lanes]) (*p.planes)[i] = planes_before[i];
  return x_;
}

}  // namespace softbody
