// Dynamics: a frame, in as many substeps as it takes.

#include <algorithm>
#include <cmath>
#include <limits>

#include "softbody/integrate/dynamics.h"

namespace softbody {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double most_substeps = 1e9;  // far more than there may be: less of the frame is simulated
/// s, of substeps that are not fixed: forces are far from linear over longer ones.
constexpr double longest_step = 1.0 / 60;
constexpr int many_substeps = 64;  // fewer lose hardly more than 1e-5 of a momentum in a second, see MomentumRestorer

}  // namespace

double Dynamics::stiffness_per_mass(const Batch& b) const {
  const Prototype& p = *b.prototype;
  double stiffest = softbody::stiffness_per_mass(p, {});
  if (!p.has_gas) return stiffest;
  for (auto& component : area_) component.assign(b.values(), 0);
  const Field<float> area{area_[0].data(), area_[1].data(), area_[2].data()};
  const Kernels& kernels = kernels_of(b);
  alignas(32) float volume[lanes], area2[lanes], stretch[lanes]{}, two_medians[lanes], one[lanes];
  std::fill(std::begin(one), std::end(one), 1.0f);
  kernels.volume(b.mesh->faces, at(x_, b), volume);
  kernels.medians(b.mesh->faces, at(x_, b), two_medians);
  kernels.pressure(b.mesh->faces, at(x_, b), one, area);
  kernels.square_sum(b.particles(), area, area2);
  for (const KernelSprings* list : {&b.mesh->structural, &b.mesh->bend, &b.mesh->shear})
    kernels.stretch(*list, area, stretch);
  for (int l = 0; l < b.used; ++l)
    stiffest = std::max(stiffest, softbody::stiffness_per_mass(p, {volume[l], area2[l], stretch[l], two_medians[l]}));
  return stiffest;
}

SubstepBound Dynamics::bound(double seconds) const {
  double stiffness = 0, damping = 0;  // over mass, the largest of all moving bodies
  double own_step = infinite;         // s: of the body that bears the shortest, contacts damp it or not
  double lone_step = infinite;        // s: of the one that bears the shortest without contacts
  // That keep up with the fastest body near a solid; implicit steps have no bound of stability.
  double fewest = std::max(1.0, seconds / longest_step);
  double deforming = 0;  // 1/s: a bound by the present shape tells nothing of one far from it
  shield_damping_.assign(shield_.pairs.empty() ? 0 : x_[0].size(), 0);
  for (ShieldPair p : shield_.pairs) {
    p.offset = glm::vec3(bodies_[p.body_a].origin - bodies_[p.body_b].origin);  // moved with them at the frame's end
    const float c = shield_.damping_ahead(p, {x_[0].data(), x_[1].data(), x_[2].data()},
                                          {v_[0].data(), v_[1].data(), v_[2].data()}, float(seconds));
    shield_damping_[p.slot_a] += c;
    shield_damping_[p.slot_b] += c;
  }
  for (const Batch& b : batches_) {
    if (!moves(b)) continue;
    const Prototype& p = *b.prototype;
    double stiffest = stiffness_per_mass(b);
    double damper = p.spring_damping_bound;
    lone_step = std::min(lone_step, integrator_->stable_step(stiffest, damper / p.particle_mass));
    if (!shield_.pairs.empty()) {
      const auto k = static_cast<float>(p.material.contact_stiffness);
      stiffest += Shield::stiffness_bound(k) / p.particle_mass;
      const float* own = shield_damping_.data() + b.base;
      damper += double(*std::max_element(own, own + b.values()));
    }
    // What is stable only by damping must not count on that of contacts, or of another body.
    own_step = std::min(own_step, integrator_->stable_step(stiffest, p.spring_damping_bound / p.particle_mass));
    const Extent motion = extent(b, v_, v_);
    if (!b.near_solids.empty()) fewest = std::max(fewest, motion.longest() * seconds / (0.1 * p.radius));
    deforming = std::max(deforming, motion.widest() / (0.1 * p.radius));
    stiffness = std::max(stiffness, stiffest);
    damping = std::max(damping, damper / p.particle_mass);
  }
  return {std::min(own_step, integrator_->stable_step(stiffness, damping)), fewest, deforming, 1 / lone_step};
}

int Dynamics::substeps(const SubstepBound& b, double seconds, double at_least) {
  return int(std::min(most_substeps, std::ceil(std::max({b.fewest, seconds / b.step, at_least}))));
}

int Dynamics::substeps(double seconds) const { return substeps(bound(seconds), seconds, 1); }

/// None that is held may cut a frame of `seconds` short.
void Dynamics::hold(const SubstepBound& b, double seconds) {
  held_rate_.ask(std::min(std::max(b.swinging, b.deforming), most_explicit_substeps() / seconds));
}

/// That a frame may have, unless they are fixed.
int Dynamics::most_explicit_substeps() const { return max_work_.substeps(max_substeps, particle_count()); }

/// Those for what is left of a frame, or as many as keep up with a body that is changing its shape, or as are held.
int Dynamics::needed_substeps(const Progress& frame) {
  const SubstepBound b = bound(frame.left);
  shield_work_ += double(shield_.pairs.size());
  constexpr double nearly = 1 - 1e-9;  // the rest of a frame takes what is left of its substeps, but for rounding
  if (!std::isfinite(b.step)) return substeps(b, frame.left, frame.left * b.implicit_rate(frame.seconds) * nearly);
  hold(b, frame.seconds);
  return substeps(b, frame.left, frame.left * std::max(b.deforming, held_rate_.rate() * nearly));
}

/// How many substeps of h seconds the bound of substeps() may be trusted for: it is worked out anew before the fastest
/// body has moved a fifth of its radius, for a body that is being crushed gets stiffer, or about a quarter of the
/// shield's thickness, for a contact that is being pressed damps more.
int Dynamics::substeps_within_bound(double h) const {
  constexpr double most = 16;
  double trusted = most;
  for (const Batch* b : crew_.moving()) {
    const double radius = b->prototype->radius, pressed = std::max(0.25 * double(shield_.thickness), 0.05 * radius);
    const double way = shield_.pairs.empty() ? 0.2 * radius : std::min(pressed, 0.2 * radius);
    trusted = std::min(trusted, way / (fastest(*b) * h));
  }
  return static_cast<int>(trusted);
}

void Dynamics::begin_frame(double seconds) {
  found_ = surface_work_ = implicit_ = shield_work_ = 0;
  held_rate_.pass(seconds);
  if (has_surface_) wake_what_is_hit(seconds);
  std::vector<Batch*> moving;
  std::size_t particles = 0;
  if (has_restitution_) before_ = v_;
  for (Batch& b : batches_) {
    b.impulse = {};
    b.returned = {};
    b.touched = 0;
    if (!moves(b)) continue;
    moving.push_back(&b);
    particles += b.particles() * std::size_t(b.used);
    prepare_solids(b, seconds);
  }
  crew_.take(std::move(moving), particles);
  if (asked_->automatic && !crew_.moving().empty()) choose(seconds);
  resize_scratch();
  for (const ShieldPair& p : shield_.pairs) touch(p.body_a), touch(p.body_b);
  if (grab_) touch(grab_->body);
}

Advance Dynamics::advance(double seconds, const std::function<void()>& after_substep) {
  begin_frame(seconds);
  if (crew_.moving().empty()) return {0, seconds};
  Progress frame{seconds, seconds};
  frame.fixed = fixed_substeps_.value_or(0) * integrator_->substeps;
  frame.most = frame.fixed ? frame.fixed : integrator_->implicit ? max_implicit_steps : most_explicit_substeps();
  do take_substeps(frame, after_substep);
  while (frame.left > 0 && !spent(frame));
  const glm::dvec3 fall = has_gravity_ ? (seconds - frame.left) * scene_.gravity : glm::dvec3(0.0);
  frame.momenta.restore(fall, integrator_->keeps_spin);
  return {frame.substeps, seconds - frame.left};
}

/// Whether a frame has had as many substeps, or as much work, as it may.
bool Dynamics::spent(const Progress& frame) const {
  if (frame.substeps >= frame.most) return true;
  const double times = max_work_.times(particle_count());
  return !frame.fixed && (surface_work_ >= times * max_work_.surface || implicit_ >= times * max_work_.implicit ||
                          shield_work_ >= times * max_work_.shield);
}

/// As many substeps as what bounds them may be trusted for.
void Dynamics::take_substeps(Progress& frame, const std::function<void()>& after_substep) {
  const int most = frame.most - frame.substeps, stable = frame.fixed ? most : needed_substeps(frame);
  if (has_surface_) {
    find_surface_contacts(frame.left, frame.left / stable, frame.left / stable);
    for (const collide::surface::SurfacePair& p : surface_.search().pairs()) touch(p.a), touch(p.b);
  }
  const int count = frame.fixed ? stable : substeps_left(frame, stable);
  if (frame.substeps == 0 && !integrator_->implicit && count >= many_substeps)
    for (Batch* b : crew_.moving()) frame.momenta.note(view(*b));
  const double h = frame.left / count;
  int now = frame.fixed ? count : std::clamp(substeps_within_bound(h), 1, count);
  // Then it is looked whether the candidates still hold: at once where their speed decides the count.
  if (!surface_.empty()) now = std::min(now, frame.fixed || count > stable ? 1 : 4);
  if (has_surface_) now = std::min(now, foreseen_substeps(frame.left, h));
  now = std::min(now, most);
  int done = 0;
  const auto go_on = [&](int steps) {
    run(steps, static_cast<float>(h), frame.substeps == 0, after_substep);
    done += steps;
    frame.substeps += steps;
    shield_work_ += double(shield_.pairs.size()) * steps;
    if (!surface_.empty()) surface_work_ += surface_.work_of_substep(float(h)) * steps;
    count_implicit_work();
  };
  if (frame.substeps == 0 && now > 1 && !frame.fixed) {
    go_on(1);  // what pulls at bodies that were moved by hand, or let go, shows in their speed only then
    now = std::min(now, 1 + substeps_within_bound(h));
  }
  // One implicit step can be a large part of the work that there may be.
  while (done < now && (done == 0 || !spent(frame))) go_on(integrator_->implicit ? 1 : now - done);
  frame.left = done == count ? 0 : frame.left - done * h;
}

/// For what is left of a frame: those that are stable, or as many as the candidates of surface contact ask for.
int Dynamics::substeps_left(const Progress& frame, int stable) const {
  const double left = frame.left;
  int count = std::max(stable, int(std::min(most_substeps, std::ceil(left * surface_.rate()))));
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
