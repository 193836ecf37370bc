// Dynamics: implicit steps of a batch.

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include <glm/geometric.hpp>

#include "softbody/contact/law.h"
#include "softbody/contact/solid_placement.h"
#include "softbody/integrate/dynamics.h"
#include "softbody/integrate/implicit/energy.h"
#include "softbody/integrate/implicit/frames.h"
#include "softbody/integrate/implicit/planes.h"
#include "softbody/integrate/implicit/stages.h"
#include "softbody/integrate/integrator_steps.h"
#include "softbody/scene/solids.h"
#include "softbody/state/rigid_motion.h"

namespace softbody {

/// What implicit steps keep: the matrices used last, and one workspace a body model for each thread.
struct ImplicitSteps {
  struct MatrixOf {
    std::shared_ptr<const BodyModel> model;
    double h;
    std::shared_ptr<const ImplicitMatrix> matrix;
  };
  const ImplicitKernels& kernels;
  std::vector<MatrixOf> matrices;
  std::vector<std::map<std::shared_ptr<const BodyModel>, ImplicitWork>> work;
};

namespace {

ImplicitProblem problem_of(const Batch& b, const ImplicitMatrix& matrix, double h, ImplicitWork& work) {
  return {*b.model,
          matrix,
          h,
          work.moves.data(),
          &work.local_x,
          &work.local_v,
          &work.a,
          &work.frame_displacement,
          &work.planes,
          &work.penalty_pairs};
}

/// Takes the start into the lanes' frames, with what acts there; only these lanes are solved for.
void enter(const ImplicitFrames& frames, ImplicitWork& work) {
  work.moves = frames.moves();
  work.local_x = work.x, work.local_v = work.v;
  frames.enter(work.local_x, work.local_v, work.frame_displacement);
  frames.accelerations(work.local_x, work.local_v, work.a);
}

}  // namespace

/// What no body needs any more goes: body models that are no longer there, and of the others' matrices the oldest.
void Dynamics::prepare_implicit(float h) {
  if (!implicit_steps_)
    implicit_steps_ = std::make_shared<ImplicitSteps>(ImplicitSteps{implicit_kernels(isa_), {}, {}});
  auto& [kernels, matrices, work] = *implicit_steps_;
  constexpr std::size_t max_lengths = 8;  // kept of one body model, two of them in use
  const auto gone = [this](const std::shared_ptr<const BodyModel>& p) {
    return std::none_of(batches_.begin(), batches_.end(), [&](const Batch& b) { return b.model == p; });
  };
  std::erase_if(matrices, [&](const ImplicitSteps::MatrixOf& m) { return gone(m.model); });
  work.resize(std::size_t(crew_.workers().threads()));
  for (auto& of_thread : work) std::erase_if(of_thread, [&](const auto& entry) { return gone(entry.first); });
  for (const Batch* b : crew_.moving()) {
    const auto& p = b->model;
    for (int thread = 0; thread < crew_.active(); ++thread) work[std::size_t(thread)].try_emplace(p, *p, kernels);
    for (const double length : {double(h), implicit_stage * double(h)}) {
      const auto of_p = [&](const ImplicitSteps::MatrixOf& m) { return m.model == p; };
      const auto known = std::find_if(matrices.begin(), matrices.end(),
                                      [&](const ImplicitSteps::MatrixOf& m) { return of_p(m) && m.h == length; });
      if (known != matrices.end()) {
        std::rotate(known, known + 1, matrices.end());  // the last ones in use stand last
        continue;
      }
      const auto other = std::find_if(matrices.begin(), matrices.end(), of_p);
      const auto matrix =
          std::make_shared<const ImplicitMatrix>(*p, length, other == matrices.end() ? nullptr : other->matrix.get());
      if (std::size_t(std::count_if(matrices.begin(), matrices.end(), of_p)) >= max_lengths) matrices.erase(other);
      matrices.push_back({p, length, matrix});
    }
  }
}

void Dynamics::count_implicit_work() {
  if (!implicit_steps_) return;
  for (auto& of_thread : implicit_steps_->work)
    for (auto& [model, work] : of_thread) implicit_ += work.solver.take_work();
}

const ImplicitMatrix& Dynamics::implicit_matrix(const Batch& b, double h) const {
  return *std::find_if(implicit_steps_->matrices.begin(), implicit_steps_->matrices.end(),
                       [&](const ImplicitSteps::MatrixOf& m) { return m.model == b.model && m.h == h; })
              ->matrix;
}

/// The planes of near solids before each particle; which lanes meet one by what moves them at the start.
std::array<bool, lanes> Dynamics::find_planes(const Batch& b, const ImplicitFrames& frames, ImplicitWork& work,
                                              double h) const {
  std::array<bool, lanes> in_contact{};
  const std::size_t n = b.particles() * lanes;
  work.planes.clear();
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    if (b.moves[lane] <= 0) continue;
    for (const SolidArguments& s : b.near_solids)
      for (std::size_t at = lane; at < n; at += lanes) {
        const glm::dvec3 place(s.place.x[lane], s.place.y[lane], s.place.z[lane]);
        const glm::dvec3 x = read(work.x, at), v = read(work.v, at);
        const auto surface =
            std::visit([&](const auto& shape) { return body::surface_at(shape, as_vec<double>(x - place)); }, s.shape);
        const glm::dvec3 normal(surface.normal.x, surface.normal.y, surface.normal.z);
        const double out = law::min_move(surface.distance, h);
        const bool meets = glm::dot(frames.free_displacement(lane, x, v), normal) < out;
        in_contact[lane] = in_contact[lane] || meets;
        // It is thrown back by what brings it there but for the spin, which takes it on, along its circle.
        const double approach = -glm::dot(frames.velocity_without_spin(lane, x, v), normal);
        double min_displacement = out;
        if (meets)
          min_displacement = std::max(min_displacement, std::min(0.0, glm::dot(frames.turn(lane, x), normal)) +
                                                            law::rebound(approach, h * double(s.restitution)));
        work.planes.push_back(
            {at, double(s.friction), double(s.restitution), normal, min_displacement, std::max(0.0, out)});
      }
  }
  return in_contact;
}

std::array<bool, lanes> Dynamics::find_penalty_pairs(const Batch& b, ImplicitWork& work, double h) const {
  std::array<bool, lanes> in_contact{};
  work.penalty_pairs.clear();
  if (penalty_.pairs.empty()) return in_contact;
  const Field<const float> x{x_[0].data(), x_[1].data(), x_[2].data()}, v{v_[0].data(), v_[1].data(), v_[2].data()};
  const auto velocity = [&](std::size_t slot) { return glm::dvec3(v.x[slot], v.y[slot], v.z[slot]); };
  const auto index = static_cast<std::size_t>(&b - batches_.data());
  for (std::uint32_t e = penalty_.first_end[index]; e < penalty_.first_end[index + 1]; ++e) {
    const PenaltyEnd& end = penalty_.ends[e];
    const PenaltyPair& pair = penalty_.pairs[end.pair];
    const PenaltyContact::Slopes slopes = penalty_.slopes(pair, x, v, float(h));
    if (slopes.spring <= 0) continue;
    const std::size_t other = end.sign > 0 ? pair.slot_b : pair.slot_a, at = end.slot - b.base;
    const bool moves = bodies_[end.sign > 0 ? pair.body_b : pair.body_a].moves();
    LinearPenaltyPair s{.at = at, .normal = double(end.sign) * glm::dvec3(pair.normal), .slopes = slopes};
    s.force = double(end.sign) * glm::dvec3(penalty_.force[end.pair]);
    s.friction = double(pair.friction);
    s.partner = moves ? h * velocity(other) : glm::dvec3(0.0);
    s.start_separation = h * velocity(end.slot) - s.partner;
    s.max_work = double(PenaltyContact::approach_limit) * penalty_.energy(pair, x) +
                 double(penalty_.max_force(pair)) * glm::length(s.partner);
    work.penalty_pairs.push_back(s);
    in_contact[at % lanes] = true;
  }
  return in_contact;
}

/// Restores what the solve has lost of the lanes' linear and angular momentum, in end_v: springs and gas change
/// neither, gravity and the other forces by as much as they act.
void Dynamics::correct_solver_momentum(const Batch& b, const ImplicitFrames& frames, ImplicitWork& work,
                                       const std::array<bool, lanes>& which, double h) const {
  const std::size_t n = b.particles();
  const double mass = b.model->particle_mass;
  const glm::dvec3 gravity = has_gravity_ ? scene_.gravity : glm::dvec3(0.0);
  for (std::size_t l = 0; l < lanes; ++l) {
    if (!which[l] || b.moves[l] <= 0) continue;
    const LaneView end_x{work.end_x, l};
    const RigidMotion &before = frames.start(l), after = rigid_motion(n, end_x, LaneView{work.end_v, l});
    glm::dvec3 total(0.0), torque(0.0);
    for (const LinearPenaltyPair& s : work.penalty_pairs) {
      if (s.at % lanes != l) continue;
      const glm::dvec3 end = read(work.end_x, s.at), force = s.force_after(end - read(work.x, s.at));
      total += force;
      torque += glm::cross(end - after.centre, force);
    }
    const glm::dvec3 push = before.velocity + h * (total / (mass * double(n)) + gravity) - after.velocity;
    const glm::dvec3 spin = after.spin_of(before.momentum + h / mass * torque - after.momentum);
    for (std::size_t i = 0; i < n; ++i)
      softbody::add(work.end_v, i * lanes + l, push + glm::cross(spin, end_x(i) - after.centre));
  }
}

/// end_x and end_v of the two stages; which lanes have converged. Springs, gas and dampers enter by Alexander's method,
/// what else acts in a frame by the explicit one that goes with it (Ascher, Ruuth and Spiteri 1997, "Implicit-explicit
/// Runge-Kutta methods", (2,2,2)).
std::array<bool, lanes> Dynamics::second_order_step(const Batch& b, const ImplicitFrames& frames, ImplicitWork& work,
                                                    double h) const {
  const double length = implicit_stage * h, second = 1 / (2 * implicit_stage);  // the second stage's share in them
  enter(frames, work);
  ImplicitProblem problem = problem_of(b, implicit_matrix(b, length), length, work);
  std::array<bool, lanes> converged;
  work.end_x = work.solver.solve(problem);
  for (int l = 0; l < lanes; ++l) converged[std::size_t(l)] = work.solver.converged(l);
  for (std::size_t i = 0; i < work.end_x.size(); ++i) {
    const double v = work.end_v[i] = (work.end_x[i] - work.local_x[i]) / length;
    work.stage_x[i] = work.local_x[i] + (1 - implicit_stage) * h * v;
    work.stage_v[i] = work.local_v[i] + (1 - implicit_stage) / implicit_stage * (v - work.local_v[i]);
  }
  frames.accelerations(work.end_x, work.end_v, work.stage_a);
  for (std::size_t i = 0; i < work.a.size(); ++i)
    work.stage_a[i] = work.a[i] + second / implicit_stage * (work.stage_a[i] - work.a[i]);
  problem.x = &work.stage_x, problem.v = &work.stage_v, problem.a = &work.stage_a;
  work.end_x = work.solver.solve(problem);
  for (int l = 0; l < lanes; ++l) converged[std::size_t(l)] = converged[std::size_t(l)] && work.solver.converged(l);
  for (std::size_t i = 0; i < work.end_x.size(); ++i) work.end_v[i] = (work.end_x[i] - work.stage_x[i]) / length;
  frames.leave(work.end_x, work.end_v);
  return converged;
}

/// end_x and end_v, and the planes' forces.
void Dynamics::first_order_step(const Batch& b, const ImplicitFrames& frames, ImplicitWork& work, double h) const {
  enter(frames, work);
  std::vector<PlaneContact> planes = work.planes;
  std::vector<LinearPenaltyPair> penalty_pairs = work.penalty_pairs;
  for (PlaneContact& c : planes) c.normal = frames.enter(c.at % lanes, c.normal);
  for (LinearPenaltyPair& s : penalty_pairs) s = frames.enter(s);
  ImplicitProblem problem = problem_of(b, implicit_matrix(b, h), h, work);
  problem.planes = &planes, problem.penalty_pairs = &penalty_pairs;
  work.end_x = work.solver.solve(problem);
  for (std::size_t i = 0; i < work.end_x.size(); ++i) work.end_v[i] = (work.end_x[i] - work.local_x[i]) / h;
  frames.leave(work.end_x, work.end_v);
  for (std::size_t i = 0; i < planes.size(); ++i)
    work.planes[i].force = frames.leave(planes[i].at % lanes, planes[i].force);
}

void Dynamics::solve_implicit(const Worker& worker, Batch& b, Quantity mean, Quantity rest, float step) {
  const double h = double(step);
  const glm::dvec3 gravity = has_gravity_ ? scene_.gravity : glm::dvec3(0.0);
  ImplicitWork& work = implicit_steps_->work[std::size_t(worker.index())].at(b.model);
  const std::size_t stride = b.particles() * lanes;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < stride; ++i) {
      work.x[k * stride + i] = double(x_[k][b.base + i]);
      work.v[k * stride + i] = double(v_[k][b.base + i]);
    }
  std::array<bool, lanes> moving{}, free{}, again{};  // free: no contact; again: takes a step of first order
  for (std::size_t l = 0; l < lanes; ++l) moving[l] = b.moves[l] > 0;
  const ImplicitFrames frames(work.x, work.v, moving, h, gravity);
  const std::array<bool, lanes> solid = find_planes(b, frames, work, h), in_pair = find_penalty_pairs(b, work, h);
  for (std::size_t l = 0; l < lanes; ++l) {
    free[l] = moving[l] && !solid[l] && !in_pair[l];
    again[l] = moving[l] && !free[l];
  }
  Lanes x = work.x, v = work.v;
  if (std::ranges::count(free, true) > 0) {
    const auto planes = std::exchange(work.planes, {});
    const auto penalty_pairs = std::exchange(work.penalty_pairs, {});
    const std::array<bool, lanes> converged =
        second_order_step(b, frames.subset(free).falling(h * h / 2 * gravity), work, h);
    correct_solver_momentum(b, frames, work, free, h);
    x = work.end_x, v = work.end_v;
    work.planes = planes;
    work.penalty_pairs = penalty_pairs;
    const std::array<bool, lanes> behind = behind_planes(work);
    for (std::size_t l = 0; l < lanes; ++l)
      if (free[l]) again[l] = !converged[l] || behind[l] || energy_gain(*b.model, work, l, gravity, false) > 0;
  }
  if (std::ranges::count(again, true) > 0) {
    std::erase_if(work.planes, [&](const PlaneContact& c) { return !again[c.at % lanes]; });
    first_order_step(b, frames.subset(again), work, h);
    std::array<bool, lanes> apart = again;
    for (const PlaneContact& c : work.planes)
      if (c.force != glm::dvec3(0.0)) apart[c.at % lanes] = false;
    correct_solver_momentum(b, frames, work, apart, h);
    clear_planes(work, h);
    for (std::size_t l = 0; l < lanes; ++l)
      if (again[l] && (!satisfies_momentum_balance(*b.model, work, l, h, gravity) ||
                       !dissipate(*b.model, work, l, energy_gain(*b.model, work, l, gravity, !apart[l]), !apart[l])))
        rigid_fallback_step(work, l, h, gravity);
    for (std::size_t i = 0; i < x.size(); ++i)
      if (again[i % lanes]) x[i] = work.end_x[i], v[i] = work.end_v[i];
    for (const PlaneContact& c : work.planes) {
      const std::size_t l = c.at % lanes;
      const glm::dvec3 impulse = h * glm::dot(c.force, c.normal) * c.normal;
      b.impulse.x[l] += float(impulse.x), b.impulse.y[l] += float(impulse.y), b.impulse.z[l] += float(impulse.z);
      b.returned[l] += float(c.restitution * glm::length(impulse));
    }
  }
  // What solids throw back is in the solve: for the velocities' contact nothing has come at them.
  if (has_restitution_)
    for (LaneArray<float>& component : before_)
      std::fill_n(component.begin() + std::ptrdiff_t(b.base), b.values(), 0.0f);
  Components &during = components(mean), &after = components(rest);
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < stride; ++i) {
      if (b.moves[i % lanes] <= 0) continue;
      const double mean_v = (x[k * stride + i] - work.x[k * stride + i]) / h;
      during[k][b.base + i] = float(mean_v);
      after[k][b.base + i] = float(v[k * stride + i] - mean_v);
    }
}

void implicit_step(Dynamics& dynamics, const Worker& worker, const Substep& substep) {
  constexpr Quantity mean = scratch(0), rest = scratch(1);
  dynamics.contact_forces(worker, substep.h);
  for (Batch* batch : worker.batches()) {
    dynamics.solve_implicit(worker, *batch, mean, rest, substep.h);
  }
  worker.barrier();  // no thread still reads the velocities for penalty contacts
  for (Batch* batch : worker.batches()) {
    dynamics.copy(*batch, mean, velocities);
    dynamics.pull(*batch);
  }
  dynamics.contacts(worker, substep.h);
  for (Batch* batch : worker.batches()) {
    dynamics.drift(*batch, substep.h);
    dynamics.add(*batch, velocities, 1, rest);
  }
  worker.barrier();
}

}  // namespace softbody
