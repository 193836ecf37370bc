#include "softbody/integrate/motion.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

#include "softbody/integrate/force_stage.h"
#include "softbody/integrate/implicit/implicit_steps.h"
#include "softbody/integrate/integrators.h"
#include "softbody/state/kernels.h"

namespace softbody {
namespace {

std::size_t used(const Batch& b) { return std::size_t(b.used); }

}  // namespace

void Motion::set_plan(const Plan& plan) {
  ForceMask taken;
  for_each_force(Forces{}, [&]<class F>(Name<F>) { taken[index_of<F>] = plan.has(stage_of<F>); });
  forces_.set_plan(taken);
}

void Motion::begin_frame(const Integrator& integrator, const glm::dvec3& gravity, const glm::dvec3& wind,
                         const BatchShares& shares) {
  gravity_ = gravity, wind_ = wind;
  scratch_.resize(std::size_t(integrator.scratch));
  for (auto& one : scratch_)
    for (auto& c : one) c.resize(parts_.state.x[0].size());
  volumes_.resize(parts_.state.batches().size());
  std::size_t most = 0;
  for (const Batch* b : shares.moving()) most = std::max(most, b->values());
  own_forces_.resize(std::size_t(shares.active()));
  for (auto& one : own_forces_)
    for (auto& c : one) c.assign(most, 0);
}

void Motion::begin_substeps(const Integrator& integrator, float h) {
  h_ = h;
  penalty_step_ = {h, integrator.implicit ? std::numeric_limits<float>::infinity() : PenaltyContact::max_damped / h,
                   !integrator.implicit};
}

void Motion::show(const Batch& b) { parts_.penalty.gather(b, field(parts_.state.x), field(parts_.state.v)); }

void Motion::contact_forces(const BatchShare& share, float h) {
  PenaltyContact& penalty = parts_.penalty;
  if (penalty.pairs().empty()) return;
  PenaltyContact::Substep step = penalty_step_;
  step.seconds = h;
  penalty.evaluate(share.part(penalty.pairs().size()), step);
  share.barrier();
}

void Motion::all_forces(const Batch& b) {
  clear(b, forces);
  forces_.add(step_of(b, h_));
}

void Motion::advance_velocities(const BatchShare& share, const Batch& b, float h, Volumes how) {
  ForceBatch step = step_of(b, h);
  Field<float> drift{};
  if (is_acted_on(share, b)) {
    clear(b, forces);
  } else {
    step.f = field(own_forces_[std::size_t(share.thread)]);
    drift = field(parts_.state.x, b.base);
  }
  forces_.advance(step, {how, drift}, volumes_[b.index]);
  impose_holds(b);
}

void Motion::advance_positions(const BatchShare& share, const Batch& b, float h) {
  if (is_acted_on(share, b)) drift(b, h);
  show(b);
}

/// Contacts stop a part of what the pressure at the end was found for. Each time the pressure is found again, what is
/// missing becomes less by the share of the surface that contacts hold.
void Motion::contacts_under_pressure(const BatchShare& share, float h) {
  constexpr int times = 3;
  contacts(share, h);
  const auto near = [&](const Batch& b) { return !parts_.solids.near(b).empty(); };
  const auto near_one = [&](const Batch* b) { return near(*b); };
  const bool surfaces = parts_.contacts.meets_others(share), touch = surfaces && parts_.contacts.surfaces().rows() > 0;
  if (!touch && (surfaces ? std::ranges::none_of(parts_.state.batches(), near)  // all threads are to agree
                          : std::ranges::none_of(share.batches, near_one)))
    return;
  for (int i = 0; i < times; ++i) {
    for (const Batch* b : share.batches)
      if (touch || near(*b)) {
        forces_.press_again(step_of(*b, h), volumes_[b->index]);
        impose_holds(*b);
      }
    contacts(share, h);
  }
}

void Motion::other_forces(const Batch& b) {
  clear(b, forces);
  forces_.add_unprojected(step_of(b, h_));
}

void Motion::project(const Batch& b, Quantity x0, Quantity d, float h) {
  forces_.project(step_of(b, h), field(std::as_const(array(x0)), b.base), field(array(d), b.base));
}

void Motion::pull(const Batch& b, float h) { forces_.kick(step_of(b, h)); }

void Motion::solve_implicit(const BatchShare& share, const Batch& b, Quantity mean, Quantity rest, float h) {
  const State& state = parts_.state;
  PenaltyContact& penalty = parts_.penalty;
  parts_.implicit.advance(share.thread,
                          {.batch = b,
                           .x = field(state.x),
                           .v = field(state.v),
                           .gravity = acceleration_of(b),
                           .near_solids = parts_.solids.near(b),
                           .features = parts_.solids.find_feature_rows(b, h),
                           .penalty = penalty,
                           .ends = penalty.ends_of(b),
                           .is_moving = [&state](BodyId body) { return state.body(body).moves(); },
                           .held = state.held.of(b)},
                          {field(array(mean)), field(array(rest)), parts_.solids.sums(b)}, double(h));
}

void Motion::kick(const Batch& b, float h) {
  state_kernels(b.width).kick(used(b), step_of(b, h).kick_arguments(), f(b), v(b));
  impose_holds(b);
}

void Motion::drift(const Batch& b, float h) {
  impose_holds(b);
  add(b, positions, h, velocities);
}

void Motion::accelerations(const Batch& b) {
  const glm::vec3 g(acceleration_of(b));
  state_kernels(b.width).accelerate(
      used(b), {b.particles(), 1, float(1 / b.model->particle_mass), g.x, g.y, g.z, b.moves.data()}, f(b));
  for (const HeldParticle& p : parts_.state.held.of(b))
    for (auto& component : parts_.state.f) component[p.slot] = 0;
}

void Motion::count_work_of_holds(const BatchShare& share, const Batch& b, float h) {
  VectorArray& own = own_forces_[std::size_t(share.thread)];
  ForceBatch step = step_of(b, h);
  step.f = field(own);
  forces_.add(step);
  parts_.state.held.end_substep(parts_.state, b, step.f, step.gravity, h);
  for (auto& component : own) std::ranges::fill(component, 0.0f);
}

VectorArray& Motion::array(Quantity q) {
  assert(q.index >= 0 && std::size_t(q.index) < 3 + scratch_.size());
  VectorArray* const own[] = {&parts_.state.x, &parts_.state.v, &parts_.state.f};
  return q.index < 3 ? *own[q.index] : scratch_[std::size_t(q.index - 3)];
}

void Motion::copy(const Batch& b, Quantity from, Quantity to) {
  state_kernels(b.width).copy(used(b), b.particles(), b.moves.data(), field(array(from), b.base),
                              field(array(to), b.base));
}

void Motion::add(const Batch& b, Quantity to, float times, Quantity q) {
  state_kernels(b.width).add(used(b), b.particles(), b.moves.data(), times, field(array(q), b.base),
                             field(array(to), b.base));
}

void Motion::scale(const Batch& b, Quantity q, float times) {
  state_kernels(b.width).scale(used(b), b.particles(), b.moves.data(), times, field(array(q), b.base));
}

void Motion::clear(const Batch& b, Quantity q) {
  for (auto& component : array(q)) std::fill_n(component.data() + b.base, b.values(), 0.0f);
}

}  // namespace softbody
