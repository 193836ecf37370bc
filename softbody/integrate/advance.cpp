// Dynamics: a frame, in as many substeps as it takes.

#include <algorithm>
#include <cmath>
#include <limits>

#include "softbody/forces/penalty_contact.h"
#include "softbody/integrate/dynamics.h"

namespace softbody {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double unbounded_substeps = 1e9;  // far more than there may be: less of the frame is simulated
/// s, of substeps that are not fixed: forces are far from linear over longer ones.
constexpr double max_step = 1.0 / 60;
constexpr int many_substeps = 64;  // fewer lose hardly more than 1e-5 of a momentum in a second, see MomentumRestorer

}  // namespace

ForceBound Dynamics::own_bound(const Batch& b) const {
  for (auto& component : area_) component.assign(b.values(), 0);
  return force_set_.bound({*b.model, b.used, at(x_, b), {area_[0].data(), area_[1].data(), area_[2].data()}}, b.width);
}

SubstepBound Dynamics::bound(double seconds) const {
  double stiffness = 0, damping = 0;  // over mass, the largest of all moving bodies
  double own_step = infinite;         // s: of the body that bears the shortest, contacts damp it or not
  double lone_step = infinite;        // s: of the one that bears the shortest without contacts
  // That keep up with the fastest body near a solid; implicit steps have no bound of stability.
  double min_substeps = std::max(1.0, seconds / max_step);
  double deformation_rate = 0;  // 1/s: a bound by the present shape tells nothing of one far from it
  penalty_damping_.assign(penalty_.pairs.empty() ? 0 : x_[0].size(), 0);
  for (PenaltyPair p : penalty_.pairs) {
    p.offset = glm::vec3(bodies_[p.body_a].origin - bodies_[p.body_b].origin);  // moved with them at the frame's end
    const float c = penalty_.predicted_damping(p, {x_[0].data(), x_[1].data(), x_[2].data()},
                                               {v_[0].data(), v_[1].data(), v_[2].data()}, float(seconds));
    penalty_damping_[p.slot_a] += c;
    penalty_damping_[p.slot_b] += c;
  }
  for (const Batch& b : batches_) {
    if (!moves(b)) continue;
    const BodyModel& p = *b.model;
    const ForceBound own = own_bound(b);
    double stiffest = own.stiffness, damper = own.damping;
    lone_step = std::min(lone_step, integrator_->stable_step(stiffest, damper));
    if (!penalty_.pairs.empty()) {
      const auto k = static_cast<float>(p.material[PenaltyContact::stiffness]);
      stiffest += PenaltyContact::stiffness_bound(k) / p.particle_mass;
      const float* pairs = penalty_damping_.data() + b.base;
      damper += double(*std::max_element(pairs, pairs + b.values())) / p.particle_mass;
    }
    // What is stable only by damping must not count on that of contacts, or of another body.
    own_step = std::min(own_step, integrator_->stable_step(stiffest, own.damping));
    const Extent motion = extent(b, v_, v_);
    if (!b.near_solids.empty()) min_substeps = std::max(min_substeps, motion.max_length() * seconds / (0.1 * p.radius));
    deformation_rate = std::max(deformation_rate, motion.max_diagonal() / (0.1 * p.radius));
    stiffness = std::max(stiffness, stiffest);
    damping = std::max(damping, damper);
  }
  return {std::min(own_step, integrator_->stable_step(stiffness, damping)), min_substeps, deformation_rate,
          1 / lone_step};
}

int Dynamics::count_substeps(const SubstepBound& b, double seconds, double at_least) {
  return int(std::min(unbounded_substeps, std::ceil(std::max({b.min_substeps, seconds / b.stable_step, at_least}))));
}

int Dynamics::needed_substeps(double seconds) const { return count_substeps(bound(seconds), seconds, 1); }

/// None that is held may cut a frame of `seconds` short.
void Dynamics::raise_min_substep_rate(const SubstepBound& b, double seconds) {
  substep_hysteresis_.raise(std::min(std::max(b.free_rate, b.deformation_rate), max_explicit_substeps() / seconds));
}

/// That a frame may have, unless they are fixed.
int Dynamics::max_explicit_substeps() const { return max_work_.scaled_substeps(max_substeps, particle_count()); }

/// Those for what is left of a frame, or as many as keep up with a body that is changing its shape, or as are held.
int Dynamics::plan_substeps(const Progress& frame) {
  const SubstepBound b = bound(frame.left);
  penalty_work_ += double(penalty_.pairs.size());
  constexpr double nearly = 1 - 1e-9;  // the rest of a frame takes what is left of its substeps, but for rounding
  if (!std::isfinite(b.stable_step))
    return count_substeps(b, frame.left, frame.left * b.implicit_rate(frame.seconds) * nearly);
  raise_min_substep_rate(b, frame.seconds);
  return count_substeps(b, frame.left, frame.left * std::max(b.deformation_rate, substep_hysteresis_.rate() * nearly));
}

/// How many substeps of h seconds the bound of needed_substeps() may be trusted for: it is worked out anew before the
/// fastest body has moved a fifth of its radius, for a body that is being crushed gets stiffer, or about a quarter of
/// the contact layer's thickness, for a contact that is being pressed damps more.
int Dynamics::substeps_within_bound(double h) const {
  constexpr double most = 16;
  double trusted = most;
  for (const Batch* b : crew_.moving()) {
    const double radius = b->model->radius, pressed = std::max(0.25 * double(penalty_.thickness), 0.05 * radius);
    const double way = penalty_.pairs.empty() ? 0.2 * radius : std::min(pressed, 0.2 * radius);
    trusted = std::min(trusted, way / (max_particle_speed(*b) * h));
  }
  return static_cast<int>(trusted);
}

void Dynamics::begin_frame(double seconds) {
  found_ = surface_work_ = implicit_ = penalty_work_ = 0;
  substep_hysteresis_.advance(seconds);
  if (has_surface_) wake_hit_sleepers(seconds);
  std::vector<Batch*> moving;
  std::size_t particles = 0;
  if (has_restitution_) before_ = v_;
  for (Batch& b : batches_) {
    b.impulse = {};
    b.returned = {};
    b.contacted = 0;
    if (!moves(b)) continue;
    moving.push_back(&b);
    particles += b.particles() * std::size_t(b.used);
    prepare_solids(b, seconds);
  }
  crew_.take(std::move(moving), particles);
  if (chosen_->automatic && !crew_.moving().empty()) choose_integrator(seconds);
  resize_scratch();
  for (const PenaltyPair& p : penalty_.pairs) mark_contacted(p.body_a), mark_contacted(p.body_b);
  if (grab_) mark_contacted(grab_->body);
  for (Batch* b : crew_.moving())
    if (has_external_force(*b->model)) b->contacted = ~0u;
}

FrameResult Dynamics::advance(double seconds, const std::function<void()>& after_substep) {
  begin_frame(seconds);
  if (crew_.moving().empty()) return {0, seconds};
  Progress frame{seconds, seconds};
  frame.fixed = fixed_substeps_.value_or(0) * integrator_->substeps_per_step;
  frame.max_substeps = frame.fixed ? frame.fixed : integrator_->implicit ? max_implicit_steps : max_explicit_substeps();
  do take_substeps(frame, after_substep);
  while (frame.left > 0 && !out_of_budget(frame));
  const glm::dvec3 fall = has_gravity_ ? (seconds - frame.left) * scene_.gravity : glm::dvec3(0.0);
  frame.momenta.restore(fall, integrator_->conserves_spin);
  return {frame.substeps, seconds - frame.left};
}

/// Whether a frame has had as many substeps, or as much work, as it may.
bool Dynamics::out_of_budget(const Progress& frame) const {
  if (frame.substeps >= frame.max_substeps) return true;
  const double times = max_work_.times(particle_count());
  return !frame.fixed && (surface_work_ >= times * max_work_.surface || implicit_ >= times * max_work_.implicit ||
                          penalty_work_ >= times * max_work_.penalty);
}

/// As many substeps as what bounds them may be trusted for.
void Dynamics::take_substeps(Progress& frame, const std::function<void()>& after_substep) {
  const int most = frame.max_substeps - frame.substeps, stable = frame.fixed ? most : plan_substeps(frame);
  if (has_surface_) {
    find_surface_contacts(frame.left, frame.left / stable, frame.left / stable);
    for (const collide::surface::SurfacePair& p : surface_.search().pairs()) mark_contacted(p.a), mark_contacted(p.b);
  }
  const int count = frame.fixed ? stable : substeps_left(frame, stable);
  if (frame.substeps == 0 && !integrator_->implicit && count >= many_substeps)
    for (Batch* b : crew_.moving()) frame.momenta.note(view(*b));
  const double h = frame.left / count;
  int now = frame.fixed ? count : std::clamp(substeps_within_bound(h), 1, count);
  // Then it is looked whether the candidates still hold: at once where their speed decides the count.
  if (!surface_.empty()) now = std::min(now, frame.fixed || count > stable ? 1 : 4);
  if (has_surface_) now = std::min(now, predicted_substeps(frame.left, h));
  now = std::min(now, most);
  int done = 0;
  const auto go_on = [&](int steps) {
    run(steps, static_cast<float>(h), frame.substeps == 0, after_substep);
    done += steps;
    frame.substeps += steps;
    penalty_work_ += double(penalty_.pairs.size()) * steps;
    if (!surface_.empty()) surface_work_ += surface_.work_of_substep(float(h)) * steps;
    count_implicit_work();
  };
  if (frame.substeps == 0 && now > 1 && !frame.fixed) {
    go_on(1);  // what pulls at bodies that were moved by hand, or let go, shows in their speed only then
    now = std::min(now, 1 + substeps_within_bound(h));
  }
  // One implicit step can be a large part of the work that there may be.
  while (done < now && (done == 0 || !out_of_budget(frame))) go_on(integrator_->implicit ? 1 : now - done);
  frame.left = done == count ? 0 : frame.left - done * h;
}

/// For what is left of a frame: those that are stable, or as many as the candidates of surface contact ask for.
int Dynamics::substeps_left(const Progress& frame, int stable) const {
  const double left = frame.left;
  int count = std::max(stable, int(std::min(unbounded_substeps, std::ceil(left * surface_.substep_rate()))));
  if (!integrator_->implicit) return count;
  // A matrix belongs to a step length, of which there are to be few: halves, quarters, ... of a frame.
  count = std::min(count, 1 << 20);  // far more than there may be, and lengths still divide what is left
  double length = frame.seconds;
  const auto fits = [&] { return std::abs(left / length - std::round(left / length)) < 1e-6; };
  while (length > left * (1 + 1e-9) || left / length < count * (1 - 1e-9) || !fits()) length /= 2;
  return int(std::lround(left / length));
}

void Dynamics::run(int count, float h, bool first, const std::function<void()>& after_substep) {
  step_ = h;
  if (integrator_->implicit) prepare_implicit(h);
  crew_.run([&](const Worker& worker) {
    for (int s = 0; s < count; ++s) {
      if (has_restitution_)
        for (Batch* b : worker.batches())
          for (std::size_t k = 0; k < 3; ++k)
            std::copy_n(v_[k].begin() + std::ptrdiff_t(b->base), b->values(),
                        before_[k].begin() + std::ptrdiff_t(b->base));
      integrator_->advance(*this, worker, {h, first && s == 0});
      if (has_surface_) since_found_[std::size_t(worker.index())] += h;
      if (!after_substep) continue;
      worker.barrier();
      if (worker.index() == 0) after_substep();
      worker.barrier();
    }
  });
}

}  // namespace softbody
