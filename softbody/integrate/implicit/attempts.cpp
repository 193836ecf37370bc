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
double friction_of(const ImplicitWork& work, std::size_t lane) {
  double most = 0;
  for (const PlaneContact& c : work.planes)
    if (c.point.lane() == lane) most = std::max(most, c.friction);
  return most;
}

/// Moves the body in a lane with a share of its spin, rotated by as large a share of h * turning. Returns how much
/// energy it gains by that, over the energy of this spin; 0 if it gains none.
double move_rigidly(const ImplicitStep& step, ImplicitWork& work, std::size_t lane, const glm::dvec3& turning,
                    double share) {
  constexpr double rounding = 1e-9;
  const double h = step.h;
  const std::size_t particles = step.model.mesh.vertices.size();
  const LaneView x{work.x, lane}, v{work.v, lane};
  const RigidMotion& m = step.frames.start(lane);
  const glm::dmat3 turned = rotation(share * h * turning);
  const glm::dvec3 spin = share * (turned * m.spin_of(glm::transpose(turned) * m.momentum));
  const auto aside = [&](std::size_t i) { return turned * (x(i) - m.centre) - (x(i) - m.centre); };
  const glm::dvec3 meant = h * (m.velocity + h * step.gravity);
  glm::dvec3 shift = stop_at(work.planes, lane, h, meant, aside);
  if (const double stopped = glm::distance(shift, meant); stopped > 0) {
    const glm::dvec3 normal = (shift - meant) / stopped, slip = shift - glm::dot(shift, normal) * normal;
    const glm::dvec3 slower = shift - law::within_cone(slip, friction_of(work, lane) * stopped);
    shift = stop_at(work.planes, lane, h, slower, aside);  // again: the other way may lead into another plane
  }
  // Sums of squared speeds.
  double gain = -2 * glm::dot(step.gravity, shift) * double(particles), before = 0, spinning = 0;
  for (std::size_t i = 0; i < particles; ++i) {
    const glm::dvec3 round = glm::cross(spin, turned * (x(i) - m.centre)), velocity = shift / h + round;
    gain += glm::dot(velocity, velocity);
    before += glm::dot(v(i), v(i));
    spinning += glm::dot(round, round);
    write(work.end_x, i * implicit_lanes + lane, x(i) + aside(i) + shift);
    write(work.end_v, i * implicit_lanes + lane, velocity);
  }
  return gain - before <= rounding * before ? 0 : (gain - before) / spinning;
}

void move_without_gain(const ImplicitStep& step, ImplicitWork& work, std::size_t lane) {
  const RigidMotion& m = step.frames.start(lane);
  if (move_rigidly(step, work, lane, m.spin, 1) <= 0) return;
  // A body that spins fast about its long axis has far more energy where its spin takes it, at the same momentum. About
  // that momentum itself it can turn without gaining any.
  const double length = glm::length(m.momentum);
  const glm::dvec3 along = length > 0 ? m.momentum / length : glm::dvec3(0.0);
  const glm::dvec3 about = glm::dot(m.steady_spin_of(m.momentum), along) * along;
  const double excess = move_rigidly(step, work, lane, about, 1);
  if (excess <= 0 || (excess < 1 && move_rigidly(step, work, lane, about, std::sqrt(1 - excess)) <= 0)) return;
  move_rigidly(step, work, lane, about, 0);
}

}  // namespace

LaneMask second_order_step(const ImplicitStep& step, ImplicitWork& work, LaneMask tried) {
  LaneMask solved = tried & ~step.in_contact;
  if (solved.none()) return solved;
  const double h = step.h, stage = implicit_stage * h;
  const double second = 1 / (2 * implicit_stage);  // the second stage's share in what else acts
  ImplicitFrames frames = step.frames.subset(solved);
  frames.set_fall(h * h / 2 * step.gravity);
  ImplicitProblem problem = work.problem(step.model, step.stage_matrix, frames, stage);
  work.solved_x = work.solver.solve(problem);
  solved &= work.solver.converged();
  for (std::size_t i = 0; i < work.x.size(); ++i) {
    const double v = work.solved_v[i] = (work.solved_x[i] - work.local_x[i]) / stage;
    work.stage_x[i] = work.local_x[i] + (1 - implicit_stage) * h * v;
    work.stage_v[i] = work.local_v[i] + (1 - implicit_stage) / implicit_stage * (v - work.local_v[i]);
  }
  frames.accelerations(work.solved_x, work.solved_v, work.stage_a);
  for (std::size_t i = 0; i < work.x.size(); ++i)
    work.stage_a[i] = work.a[i] + second / implicit_stage * (work.stage_a[i] - work.a[i]);
  problem.x = &work.stage_x, problem.v = &work.stage_v, problem.a = &work.stage_a;
  work.solved_x = work.solver.solve(problem);
  solved &= work.solver.converged();
  for (std::size_t i = 0; i < work.x.size(); ++i) work.solved_v[i] = (work.solved_x[i] - work.stage_x[i]) / stage;
  work.finish(frames);
  restore_momentum(step, work, frames.active());
  solved &= ~behind_planes(work);
  for (std::size_t l = 0; l < implicit_lanes; ++l)
    if (solved[l]) solved[l] = energy_gain(step.model, work, l, step.gravity, false) <= 0;
  return solved;
}

LaneMask first_order_step(const ImplicitStep& step, ImplicitWork& work, LaneMask tried) {
  const ImplicitFrames frames = step.frames.subset(tried);
  ImplicitProblem problem = work.problem(step.model, step.matrix, frames, step.h);
  std::vector<PlaneContact> planes;
  std::vector<LinearPenaltyPair> pairs;
  for (const PlaneContact& c : work.planes)
    if (tried[c.point.lane()]) planes.push_back(frames.enter(c));
  for (const LinearPenaltyPair& s : work.penalty_pairs)
    if (tried[s.at % implicit_lanes]) pairs.push_back(frames.enter(s));
  problem.planes = planes, problem.penalty_pairs = pairs;
  work.solved_x = work.solver.solve(problem);
  for (std::size_t i = 0; i < work.x.size(); ++i) work.solved_v[i] = (work.solved_x[i] - work.local_x[i]) / step.h;
  work.finish(frames);
  LaneMask pushed;  // by solids
  auto solved_plane = planes.begin();
  for (PlaneContact& c : work.planes) {
    const std::size_t lane = c.point.lane();
    if (!tried[lane]) continue;
    c.force = frames.leave(lane, solved_plane++->force);
    if (c.force != glm::dvec3(0.0)) pushed.set(lane);
  }
  restore_momentum(step, work, tried & ~pushed);
  clear_planes(work, tried, step.h);
  LaneMask solved;
  for (std::size_t l = 0; l < implicit_lanes; ++l) {
    if (!tried[l] || !satisfies_momentum_balance(step.model, work, l, step.h, step.gravity)) continue;
    const double gain = energy_gain(step.model, work, l, step.gravity, pushed[l]);
    solved[l] = dissipate(step.model, work, l, gain, pushed[l]);
  }
  return solved;
}

LaneMask rigid_fallback_step(const ImplicitStep& step, ImplicitWork& work, LaneMask tried) {
  for (std::size_t l = 0; l < implicit_lanes; ++l)
    if (tried[l]) move_without_gain(step, work, l);
  for (PlaneContact& c : work.planes)
    if (tried[c.point.lane()]) c.force = glm::dvec3(0.0);
  for (LinearPenaltyPair& s : work.penalty_pairs)
    if (tried[s.at % implicit_lanes]) s.share = 0;
  return tried;
}

}  // namespace softbody
