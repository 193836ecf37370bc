#include "softbody/integrate/solver.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "softbody/integrate/force_stage.h"
#include "softbody/integrate/implicit/implicit_steps.h"
#include "softbody/mechanics/body_measures.h"

namespace softbody {
namespace {

constexpr int many_substeps = 64;  // fewer lose hardly more than 1e-5 of a momentum in a second, see MomentumRestorer

}  // namespace

std::size_t SolverState::bytes() const {
  return bodies.bytes() + penalty.pairs.bytes() + bytes_of(pushes) + rebounds.bytes() + surface.bytes();
}

Solver::Solver(const Scene& scene, const BatchShares& shares)
    : scene_(scene),
      shares_(shares),
      penalty_(scene.collision.tolerance),
      solids_(state_),
      contacts_(scene, state_, solids_, shares_),
      implicit_(std::make_unique<ImplicitSteps>()),
      motion_({state_, hand_, penalty_, solids_, contacts_, *implicit_}),
      bounds_(state_, penalty_, solids_, shares_) {}

Solver::~Solver() = default;

void Solver::set_plan(const Plan& plan) {
  gravity_ = plan.has(Stage::gravity) ? scene_.gravity : glm::dvec3(0.0);
  motion_.set_plan(plan);
  resistance_.set_plan(plan);
  contacts_.set_plan(plan);
  solids_.set_parts(plan.has(Stage::solid_features), plan.has(Stage::restitution));
  if (!plan.has(stage_of<PenaltyContact>)) penalty_.clear();
  if (!plan.has(Stage::restitution)) rebounds_ = {};
  has_holds_ = plan.has(Stage::hold);
  if (!has_holds_) state_.held = {};
}

void Solver::remove(BodyId body) {
  penalty_.remove(body, contacts_.vertices().first[body], contacts_.vertices().size(body));
  contacts_.surfaces() = {};  // found anew in the next frame
  solids_.remove(body);
  rebounds_.remove(body);
  hand_.remove(body);
  state_.remove(body);
}

/// Notes that this one may touch others, or itself.
void Solver::join(BodyId body) {
  mark_pushed(body);
  joined_[state_.body(body).batch] = true;
}

/// Hands the batches that move to the shares. Returns how many particles they have.
std::size_t Solver::take_moving_batches() {
  std::vector<const Batch*> batches;
  std::size_t particles = 0;
  for (const Batch& b : state_.batches()) {
    if (!b.any_moves()) continue;
    batches.push_back(&b);
    particles += b.particles() * std::size_t(b.used);
  }
  shares_.take(std::move(batches), particles);
  return particles;
}

/// Notes what contacts of vertices, the hand and forces from outside may push or join in this frame.
void Solver::mark_touched() {
  for (const auto* bodies : {&penalty_.pairs().body_a, &penalty_.pairs().body_b})
    for (const BodyId body : *bodies) join(body);
  if (hand_.grab()) mark_pushed(hand_.grab()->body);
  for (const Batch* b : shares_.moving())
    if (has_external_force(*b->model) || state_.held.any(*b)) pushed_[b->index] = ~0u;
}

StepBound Solver::begin_frame(double seconds) {
  contacts_.begin_frame();
  const bool press = contacts_.surfaces().presses();  // in the last frame; a search forgets it
  const double searches = contacts_.has_surfaces() ? contacts_.wake_hit_sleepers(seconds) : 0;
  solids_.begin_frame();
  pushed_.assign(state_.batches().size(), 0);
  joined_.assign(state_.batches().size(), false);
  const std::size_t particles = take_moving_batches();
  if (has_holds_) state_.held.begin_frame(state_);
  const std::vector<const Batch*>& moving = shares_.moving();
  std::vector<Extent> extents(moving.size());
  shares_.for_each(moving.size(), [&](std::size_t i) { extents[i] = state_.extent(*moving[i], state_.x, state_.v); });
  for (std::size_t i = 0; i < moving.size(); ++i)
    solids_.add(*moving[i], extents[i], scene_.solids,
                uniform_acceleration(*moving[i]->model, scene_.gravity, scene_.wind), seconds);
  const bool eased_out = std::ranges::any_of(moving, [&](const Batch* b) { return solids_.pushed(*b) != 0; });
  if (eased_out && !penalty_.pairs().empty())
    penalty_.gather(field(std::as_const(state_.x)), field(std::as_const(state_.v)));
  const StepBound bound = bounds_.measure(steps_.bounds_of());
  steps_.begin_frame(
      {.seconds = seconds,
       .particles = state_.particle_count(),
       .moving = particles,
       .penalty_pairs = penalty_.pairs().size(),
       .near_solids = std::ranges::any_of(moving, [&](const Batch* b) { return !solids_.near(*b).empty(); }),
       .surface_contact = contacts_.has_surfaces(),
       .surfaces_touch =
           press || std::ranges::any_of(moving, [&](const Batch* b) { return solids_.meets_features(*b); }),
       .too_large = std::ranges::any_of(moving, [](const Batch* b) { return b->particles() > max_implicit_particles; }),
       .rounding = StepBounds::rounding(moving, extents),
       .sleep_speed = scene_.sleep.speed},
      bound);
  steps_.spend(work::surface * searches);
  motion_.begin_frame(*steps_.plan().integrator, gravity_, scene_.wind, shares_);
  mark_touched();
  return bound;
}

/// Returns the sum of the works (J) that the wind's uniform force does on all bodies up to where they are.
double Solver::work_of_wind() const {
  double sum = 0;
  if (scene_.wind == glm::dvec3(0.0)) return sum;
  for (BodyId id = 0; id < state_.body_count(); ++id) {
    const auto* air = data<AirDrag>(state_.model(id));
    for (Index i = 0; air && i < state_.batch_of(id).particles(); ++i)
      sum += air->damping * glm::dot(scene_.wind, state_.particle(id, i).position);
  }
  return sum;
}

FrameResult Solver::advance(double seconds, const AfterSubstep& after_substep) {
  const StepBound bound = begin_frame(seconds);
  const double held = penalty_energy(), blown = work_of_wind();
  const FrameResult done =
      shares_.moving().empty() ? FrameResult{.seconds = seconds} : take_substeps(seconds, bound, after_substep);
  solids_.end_frame();
  penalty_.take_impacts(rebounds_);
  state_.ledger.book(WorkBy::surfaces, rebounds_.give_back(state_, done.seconds));
  state_.ledger.book(WorkBy::penalty, held - penalty_energy());
  state_.ledger.book(WorkBy::holds, state_.held.take_work());
  state_.ledger.book(WorkBy::wind, work_of_wind() - blown);
  return done;
}

FrameResult Solver::take_substeps(double seconds, StepBound bound, const AfterSubstep& after_substep) {
  const Integrator& integrator = *steps_.plan().integrator;
  Series series = plan_series(seconds, bound);
  FrameResult done{.needed = steps_.plan().needed};
  const auto take = [&](int count) {
    run(count, float(series.h()), done.substeps == 0, after_substep);
    count_work(count);
    series.taken += count;
    done.substeps += count;
  };
  MomentumRestorer momenta;
  if (!integrator.implicit && series.substeps >= many_substeps)
    for (const Batch* b : shares_.moving()) momenta.note({*b, field(state_.x, b->base), field(state_.v, b->base)});
  // What pulls at bodies shows only after a substep: in their speed, if they were moved by hand or let go, and in how
  // far they leave the motion that candidates were found for.
  if (contacts_.has_surfaces()) {
    series.trusted = 1;
  } else if (series.trusted > 1 && !steps_.fixed()) {
    take(1);
    series.trusted = std::min(series.trusted, 1 + StepBounds::substeps_in_shape(bounds_.fastest(), series.h()));
  }
  for (;;) {
    // One implicit step can be a large part of the work that there may be.
    while (series.taken < series.trusted && (series.taken == 0 || steps_.may_go_on()))
      take(integrator.implicit ? 1 : series.trusted - series.taken);
    if (!(series.left_after() > 0 && steps_.may_go_on())) break;
    if (!steps_.fixed()) {
      bound = bounds_.measure(steps_.bounds_of());
      steps_.spend(steps_.work_of_bound());
    }
    try {
      series = plan_series(series.left_after(), bound);
    } catch (const std::length_error&) {
      break;  // too many candidates; the next frame has them at its start
    }
    done.needed = std::min(done.needed, steps_.plan().needed);
  }
  done.seconds = seconds - series.left_after();
  for (const Batch* b : shares_.moving()) pushed_[b->index] |= solids_.pushed(*b);
  momenta.restore(done.seconds * gravity_, integrator.conserves_spin, pushed_);
  return done;
}

Solver::Series Solver::plan_series(double left, StepBound& bound) {
  const SurfaceCandidates& candidates = contacts_.surfaces().candidates();
  bound.surfaces_near = !candidates.empty();
  Series series{.left = left, .substeps = steps_.plan(bound, left).substeps};
  const double without = series.substeps;
  if (contacts_.has_surfaces()) {  // candidates for the longest substeps that all else allows may ask for shorter ones
    steps_.spend(work::surface * contacts_.find(left, series.h(), series.h()));
    for (const collide::surface::SurfacePair& p : candidates.search().pairs())
      for (const BodyId body : {p.a, p.b}) join(body);
    bound.passing = std::max(bound.passing, double(candidates.substep_rate()));
    bound.surfaces_near = !candidates.empty();
    series.substeps = steps_.plan(bound, left).substeps;
  }
  series.trusted = trusted_substeps(series, bound.fastest, series.substeps > without);
  return series;
}

/// Returns how many substeps of a series may be taken before it is looked again whether they are short enough.
/// fastest: see StepBound. surfaces_decide: how fast the candidates come closer decides the count.
int Solver::trusted_substeps(const Series& s, double fastest, bool surfaces_decide) const {
  const bool fixed = steps_.fixed();
  double count =
      fixed ? s.substeps : std::clamp(double(StepBounds::substeps_in_shape(fastest, s.h())), 1.0, s.substeps);
  if (!contacts_.surfaces().candidates().empty()) count = std::min(count, fixed || surfaces_decide ? 1.0 : 4.0);
  return contacts_.has_surfaces() ? std::min(int(count), contacts_.covered_substeps(s.left, s.h())) : int(count);
}

/// Books the work of `count` substeps that have been run, in J and as a part of the frame's budget.
void Solver::count_work(int count) {
  const bool implicit = steps_.plan().integrator->implicit;
  SurfaceContact& surface = contacts_.surfaces();
  state_.ledger.book(WorkBy::surfaces, surface.take_work(rebounds_));
  steps_.spend(count * ((implicit ? 0 : steps_.work_of_substep()) +
                        (surface.candidates().empty() ? 0 : work::surface * surface.work_of_substep())));
  steps_.spend(work::implicit * implicit_->take_work());
}

/// Returns how far (s) velocities stand behind positions in substeps of h: 0 if these are fixed, and too long to be
/// stable. Then they conserve no energy, and the plain one is not to grow.
double Solver::staggering(float h) const {
  const Integrator& i = *steps_.plan().integrator;
  const auto too_long = [&] { return (1 - i.reserve()) * double(h) * stable_rate(bounds_.measure(i), i) > 1; };
  return i.staggered && !(steps_.fixed() && too_long()) ? double(h) : 0;
}

/// Sets which energy the coming substeps conserve, by how far (s) velocities stand behind positions in them, and books
/// what the change to that gives.
void Solver::set_staggering(double seconds) {
  constexpr double close = 0.2;  // of them
  double& now = state_.ledger.staggering;
  const double before = now;
  if (std::abs(seconds - before) <= close * std::max(seconds, before)) return;
  now = seconds;
  double power = 0;
  for (const BodyMeasures& b : measure_bodies(state_, gravity_)) power += b.power;
  state_.ledger.book(WorkBy::steps, (now - before) / 2 * power);
}

void Solver::prepare_implicit(float h) {
  implicit_->retain([this](const BodyModel& model) {
    return std::ranges::any_of(state_.batches(), [&](const Batch& b) { return b.model.get() == &model; });
  });
  for (const Batch* b : shares_.moving()) implicit_->prepare(b->model, double(h), shares_.active());
}

/// in_step: all batches take each substep together, as if contacts joined them all.
void Solver::share_batches(bool in_step) {
  shares_.deal([&](const Batch& b) {
    if (!in_step && !joined_[b.index]) return std::size_t{0};
    return b.values() + std::size_t(work::penalty_pair / 2 * double(penalty_.ends_of(b).size()));
  });
}

void Solver::run(int count, float h, bool first, const AfterSubstep& after_substep) {
  last_substep_ = h;
  const Integrator& integrator = *steps_.plan().integrator;
  // Fixed ones are equally long in a frame, and a look at whether they are stable takes a pass over all bodies.
  if (first || !steps_.fixed()) set_staggering(staggering(h));
  motion_.begin_substeps(integrator, h);
  if (integrator.implicit) prepare_implicit(h);
  const auto holds_body = [&](const Batch* b) { return hand_.holds(state_, *b); };
  const auto advance = [&](const BatchShare& share, int s) {
    for (const Batch* b : share.batches) {
      state_.held.begin_substep(state_, *b, h);
      solids_.note_velocities(*b);
    }
    const bool holds = std::ranges::any_of(share.batches, holds_body);
    if (holds) hand_.note_point(state_);
    integrator.advance(motion_, share, {h, first && s == 0});
    if (holds) hand_.book_work(state_);
    if (state_.held.moves()) motion_.contact_forces(share, 0);  // as they are at the end
    for (const Batch* b : share.batches) {
      state_.held.impose(*b, field(state_.v));
      if (state_.held.moves(*b)) motion_.count_work_of_holds(share, *b, h);
    }
    if (state_.held.moves()) share.barrier();  // until then nobody evaluates contacts anew
  };
  share_batches(bool(after_substep));
  std::atomic<std::size_t> next = 0;
  shares_.run([&](const BatchShare& share) {
    for (int s = 0; s < count; ++s) {
      advance(share, s);
      contacts_.advance(share, h);
      if (!after_substep) continue;
      share.barrier();
      if (share.thread == 0) after_substep();
      share.barrier();
    }
    // Batches that are alone take all their substeps at once, while they are in the cache.
    for (std::size_t i; (i = next++) < shares_.alone().size();)
      for (int s = 0; s < count; ++s) advance(share.alone_with(shares_.alone()[i]), s);
  });
}

void Solver::finish_frame(double seconds, Field<float> places) {
  penalty_.end_frame(seconds);
  const std::span<const Batch> batches = state_.batches();
  shares_.for_each(batches.size(), [&](std::size_t i) {
    if (batches[i].any_moves()) finish(batches[i], seconds);
    state_.write_positions(batches[i], contacts_.vertices().first, places);  // while they are in the cache
  });
  for (BodyId id = 0; id < state_.body_count(); ++id)
    state_.ledger.book(WorkBy::solids, double(std::exchange(state_.memory(id).impact.given, 0.0f)));
}

void Solver::finish(const Batch& b, double seconds) {
  std::array<SolidPush, lanes> pushes;
  std::array<Impact, lanes> impacts;
  for (std::size_t l = 0; l < std::size_t(b.used); ++l) {
    pushes[l] = solids_.push(b.body[l]);
    impacts[l] = state_.memory(b.body[l]).impact;
    if (!state_.held.of(b.body[l]).empty()) pushes[l] = {}, impacts[l] = {};  // it does not move as a whole
  }
  resistance_.apply({b, field(state_.x, b.base), field(state_.v, b.base)}, pushes, seconds, impacts);
  state_.held.impose(b, field(state_.v));
  state_.recentre(b);
  const std::array<double, lanes> speeds = state_.max_particle_speeds(b);
  for (std::size_t l = 0; l < std::size_t(b.used); ++l) {
    state_.memory(b.body[l]).impact = impacts[l];
    if (b.moves[l] > 0) state_.memory(b.body[l]).speed = speeds[l];
  }
}

SolverState Solver::save() const {
  return {state_.saved(), penalty_.memory(),           solids_.pushes(),
          rebounds_,      contacts_.surfaces().save(), steps_.hysteresis()};
}

void Solver::restore(const SolverState& saved) {
  state_.restore(saved.bodies);
  penalty_.restore(saved.penalty);
  solids_.begin_frame();
  solids_.set_pushes(saved.pushes);
  rebounds_ = saved.rebounds;
  contacts_.surfaces().restore(saved.surface);
  steps_.set_hysteresis(saved.substep_hysteresis);
  shares_.take({}, 0);
}

}  // namespace softbody
