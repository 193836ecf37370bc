#include "softbody/integrate/implicit/attempts.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "softbody/integrate/implicit/balance.h"
#include "softbody/integrate/implicit/planes.h"

namespace softbody {
namespace {

/// Returns the largest coefficient of friction of a lane's planes.
double friction_of(const ImplicitBodies& bodies, std::size_t lane) {
  double most = 0;
  for (const PlaneContact& c : bodies.planes)
    if (c.point.lane() == lane) most = std::max(most, c.friction);
  return most;
}

/// Moves the body in a lane with a share of its spin, rotated by as large a share of h * turning. Returns how much
/// energy it gains by that, over the energy of this spin; 0 if it gains none.
double move_rigidly(const ImplicitStep& step, ImplicitBodies& bodies, std::size_t lane, const glm::dvec3& turning,
                    double share) {
  constexpr double rounding = 1e-9;
  const double h = step.h;
  const std::size_t particles = step.model.mesh.vertices.size();
  const LaneView x{bodies.x, lane}, v{bodies.v, lane};
  const RigidMotion& m = step.axes.start(lane);
  const glm::dmat3 turned = rotation(share * h * turning);
  const glm::dvec3 spin = share * (turned * m.spin_of(glm::transpose(turned) * m.momentum));
  const auto aside = [&](std::size_t i) { return turned * (x(i) - m.centre) - (x(i) - m.centre); };
  const glm::dvec3 meant = h * (m.velocity + h * step.gravity);
  glm::dvec3 shift = stop_at(bodies.planes, lane, h, meant, aside);
  if (const double stopped = glm::distance(shift, meant); stopped > 0) {
    const glm::dvec3 normal = (shift - meant) / stopped, slip = shift - glm::dot(shift, normal) * normal;
    const glm::dvec3 slower = shift - law::within_cone(slip, friction_of(bodies, lane) * stopped);
    shift = stop_at(bodies.planes, lane, h, slower, aside);  // again: the other way may lead into another plane
  }
  // Sums of squared speeds.
  double gain = -2 * glm::dot(step.gravity, shift) * double(particles), before = 0, spinning = 0;
  for (std::size_t i = 0; i < particles; ++i) {
    const glm::dvec3 round = glm::cross(spin, turned * (x(i) - m.centre)), velocity = shift / h + round;
    gain += glm::dot(velocity, velocity);
    before += glm::dot(v(i), v(i));
    spinning += glm::dot(round, round);
    write(bodies.end_x, i * implicit_lanes + lane, x(i) + aside(i) + shift);
    write(bodies.end_v, i * implicit_lanes + lane, velocity);
  }
  return gain - before <= rounding * before ? 0 : (gain - before) / spinning;
}

void move_without_gain(const ImplicitStep& step, ImplicitBodies& bodies, std::size_t lane) {
  const RigidMotion& m = step.axes.start(lane);
  if (move_rigidly(step, bodies, lane, m.spin, 1) <= 0) return;
  // A body that spins fast about its long axis has far more energy where its spin takes it, at the same momentum. About
  // that momentum itself it can turn without gaining any.
  const double length = glm::length(m.momentum);
  const glm::dvec3 along = length > 0 ? m.momentum / length : glm::dvec3(0.0);
  const glm::dvec3 about = glm::dot(m.steady_spin_of(m.momentum), along) * along;
  const double excess = move_rigidly(step, bodies, lane, about, 1);
  if (excess <= 0 || (excess < 1 && move_rigidly(step, bodies, lane, about, std::sqrt(1 - excess)) <= 0)) return;
  move_rigidly(step, bodies, lane, about, 0);
}

/// Stops the particles in a lane, all but those that are held.
void stop(ImplicitBodies& bodies, std::size_t lane) {
  for (std::size_t at = lane; at < bodies.x.size() / 3; at += implicit_lanes) {
    write(bodies.end_x, at, read(bodies.x, at));
    write(bodies.end_v, at, glm::dvec3(0.0));
  }
  for (const auto& [at, place] : bodies.held)
    if (at % implicit_lanes == lane) write(bodies.end_x, at, place);
}

/// Returns the velocities that lead from the start of a solve to x in h.
Lanes mean_velocities(const ImplicitStep& step, const Lanes& x, double h) {
  Lanes v(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) v[i] = (x[i] - step.start.x[i]) / h;
  return v;
}

/// Takes a solved end back into the world, for the lanes that have axes of their own.
void finish(const MovingAxes& axes, Lanes x, Lanes v, ImplicitBodies& bodies) {
  axes.leave(x, v);
  for (std::size_t i = 0; i < x.size(); ++i)
    if (axes.active()[i % implicit_lanes]) {
      bodies.end_x[i] = x[i];
      bodies.end_v[i] = v[i];
    }
}

}  // namespace

LaneMask second_order_step(ImplicitStep& step, ImplicitBodies& bodies, LaneMask tried) {
  LaneMask solved = tried & ~step.in_contact;
  if (solved.none()) return solved;
  const double h = step.h, stage = implicit_stage * h;
  const double second = 1 / (2 * implicit_stage);  // the second stage's share in what else acts
  MovingAxes axes = step.axes.subset(solved);
  axes.set_fall(h * h / 2 * step.gravity);
  ImplicitStart& start = step.start;
  axes.enter(bodies.x, bodies.v, start);
  const ImplicitProblem problem{step.model, step.stage_matrix, stage, start, h};
  const Lanes middle = step.solver.solve(problem), middle_v = mean_velocities(step, middle, stage);
  solved &= step.solver.converged();
  Lanes a(middle.size());
  axes.accelerations(middle, middle_v, a);
  for (std::size_t i = 0; i < middle.size(); ++i) {
    start.x[i] += (1 - implicit_stage) * h * middle_v[i];
    start.v[i] += (1 - implicit_stage) / implicit_stage * (middle_v[i] - start.v[i]);
    start.a[i] += second / implicit_stage * (a[i] - start.a[i]);
  }
  const Lanes end = step.solver.solve(problem);
  solved &= step.solver.converged();
  finish(axes, end, mean_velocities(step, end, stage), bodies);
  restore_momentum(step, bodies, axes.active());
  solved &= ~behind_planes(bodies);
  for (std::size_t l = 0; l < implicit_lanes; ++l)
    if (solved[l]) solved[l] = energy_gain(step.model, bodies, l, step.gravity, false) <= 0;
  return solved;
}

LaneMask first_order_step(ImplicitStep& step, ImplicitBodies& bodies, LaneMask tried) {
  const MovingAxes axes = step.axes.subset(tried);
  axes.enter(bodies.x, bodies.v, step.start, bodies.held);
  std::vector<PlaneContact> planes;
  std::vector<LinearPenaltyPair> pairs;
  for (const PlaneContact& c : bodies.planes)
    if (tried[c.point.lane()]) planes.push_back(axes.enter(c));
  for (const LinearPenaltyPair& s : bodies.penalty_pairs)
    if (tried[s.at % implicit_lanes]) pairs.push_back(axes.enter(s));
  const Lanes end = step.solver.solve({step.model, step.matrix, step.h, step.start, step.h, planes, pairs});
  finish(axes, end, mean_velocities(step, end, step.h), bodies);
  LaneMask pushed = bodies.holds;  // by solids or holds
  auto solved_plane = planes.begin();
  for (PlaneContact& c : bodies.planes) {
    const std::size_t lane = c.point.lane();
    if (!tried[lane]) continue;
    c.force = axes.leave(lane, solved_plane++->force);
    if (c.force != glm::dvec3(0.0)) pushed.set(lane);
  }
  restore_momentum(step, bodies, tried & ~pushed);
  clear_planes(bodies, tried, step.h);
  LaneMask solved;
  for (std::size_t l = 0; l < implicit_lanes; ++l) {
    if (!tried[l]) continue;
    if (!bodies.holds[l] && !satisfies_momentum_balance(step.model, bodies, l, step.h, step.gravity)) continue;
    const double gain = energy_gain(step.model, bodies, l, step.gravity, pushed[l]);
    // Holds that move do work which is not known here.
    solved[l] = bodies.holds_move[l] ? std::isfinite(gain) : dissipate(step.model, bodies, l, gain, pushed[l]);
  }
  return solved;
}

LaneMask rigid_fallback_step(ImplicitStep& step, ImplicitBodies& bodies, LaneMask tried) {
  for (std::size_t l = 0; l < implicit_lanes; ++l)
    if (tried[l]) bodies.holds[l] ? stop(bodies, l) : move_without_gain(step, bodies, l);
  for (PlaneContact& c : bodies.planes)
    if (tried[c.point.lane()]) c.force = glm::dvec3(0.0);
  for (LinearPenaltyPair& s : bodies.penalty_pairs)
    if (tried[s.at % implicit_lanes]) s.share = 0;
  return tried;
}

}  // namespace softbody
