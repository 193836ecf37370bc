#include "softbody/dynamics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "softbody/shape_matching.h"

namespace softbody {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double most_substeps = 1e9;  // a state that asks for more is lost
constexpr int many_substeps = 64;      // fewer lose hardly more than 1e-5 of a momentum in a second, see keep_momenta()

double longest(const Extent& e) {
  return std::sqrt(double(*std::max_element(std::begin(e.length2), std::end(e.length2))));
}

/// The largest of the boxes' diagonals.
double widest(const Extent& e) {
  double most = 0;
  for (int l = 0; l < lanes; ++l)
    most = std::max(
        most, std::hypot(double(e.hi.x[l] - e.lo.x[l]), double(e.hi.y[l] - e.lo.y[l]), double(e.hi.z[l] - e.lo.z[l])));
  return most;
}

}  // namespace

Extent Dynamics::extent(const Batch& b, const Components& boxed, const Components& measured) const {
  Extent e{};
  kernels_of(b).extent(b.particles(), at(boxed, b), at(measured, b), e);
  return e;
}

double Dynamics::fastest(const Batch& b) const { return longest(extent(b, x_, v_)); }

void Dynamics::set_plan(const Plan& plan) {
  static constexpr std::pair<Stage, BatchStage> springs_and_gas[] = {
      {Stage::structural_springs, &Dynamics::structural_springs},
      {Stage::bend_springs, &Dynamics::bend_springs},
      {Stage::shear_springs, &Dynamics::shear_springs},
      {Stage::gas_pressure, &Dynamics::gas_pressure},
  };
  static constexpr std::pair<Stage, BatchStage> others[] = {
      {Stage::shape_matching, &Dynamics::shape_matching},
      {Stage::contact_response, &Dynamics::shield_forces},
  };
  force_stages_.clear();
  other_force_stages_.clear();
  for (const auto& [stage, run] : springs_and_gas)
    if (plan.has(stage)) force_stages_.push_back(run);
  for (const auto& [stage, run] : others) {
    if (!plan.has(stage)) continue;
    force_stages_.push_back(run);
    other_force_stages_.push_back(run);
  }
  if (plan.has(Stage::grab)) force_stages_.push_back(&Dynamics::grab_force);  // last: it reckons with the others
  resistance_ = {plan.has(Stage::internal_damping), plan.has(Stage::rebound_damping),
                 plan.has(Stage::rolling_resistance)};
  has_gravity_ = plan.has(Stage::gravity);
  has_restitution_ = plan.has(Stage::restitution);
  has_surface_ = plan.has(Stage::surface_contact);
  has_solid_features_ = plan.has(Stage::solid_features);
  self_contact_ = scene_.collision.self_collision;
  if (!has_surface_) surface_.clear();
  if (!plan.has(Stage::contact_response)) shield_.pairs.clear();
}

void Dynamics::set_integrator(const Integrator& integrator) {
  asked_ = integrator_ = &integrator;
  why_ = {};
  resize_scratch();
}

void Dynamics::resize_scratch() {
  scratch_.resize(std::size_t(integrator_->scratch));
  for (auto& components : scratch_)
    for (auto& c : components) c.resize(x_[0].size());
}

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

Dynamics::Bound Dynamics::bound(double seconds) const {
  double stiffness = 0, damping = 0;  // over mass, the largest of all moving bodies
  double own_step = infinite;         // s: of the body that bears the shortest by itself
  double fewest = 1;                  // that keep up with the fastest body near a solid
  double deforming = 0;               // 1/s: a bound by the present shape tells nothing of one far from it
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
    if (!shield_.pairs.empty()) {
      const auto k = static_cast<float>(p.material.contact_stiffness);
      stiffest += Shield::stiffness_bound(k) / p.particle_mass;
      const float* own = shield_damping_.data() + b.base;
      damper += double(*std::max_element(own, own + b.values()));
    }
    // What is stable only by damping must not count on that of contacts, or of another body.
    own_step = std::min(own_step, integrator_->stable_step(stiffest, p.spring_damping_bound / p.particle_mass));
    const Extent motion = extent(b, v_, v_);
    if (!b.near_solids.empty()) fewest = std::max(fewest, longest(motion) * seconds / (0.1 * p.radius));
    deforming = std::max(deforming, widest(motion) / (0.25 * p.radius));
    stiffness = std::max(stiffness, stiffest);
    damping = std::max(damping, damper / p.particle_mass);
  }
  return {std::min(own_step, integrator_->stable_step(stiffness, damping)), fewest, deforming};
}

int Dynamics::substeps(const Bound& b, double seconds, double at_least) {
  return int(std::min(most_substeps, std::ceil(std::max({b.fewest, seconds / b.step, at_least}))));
}

int Dynamics::substeps(double seconds) const { return substeps(bound(seconds), seconds, 1); }

/// Those, or as many as keep up with a body that is changing its shape.
int Dynamics::needed_substeps(double seconds) const {
  const Bound b = bound(seconds);
  return substeps(b, seconds, std::isfinite(b.step) ? seconds * b.deforming : 1);
}

bool Dynamics::moves(const Batch& b) {
  return std::any_of(b.moves.begin(), b.moves.end(), [](float m) { return m > 0; });
}

Advance Dynamics::advance(double seconds, const std::function<void()>& after_substep) {
  found_ = 0;
  if (has_surface_) wake_what_is_hit(seconds);
  moving_.clear();
  if (has_restitution_) before_ = v_;
  for (Batch& b : batches_) {
    b.impulse = {};
    b.returned = {};
    b.touched = 0;
    if (!moves(b)) continue;
    moving_.push_back(&b);
    prepare_solids(b, seconds);
  }
  if (moving_.empty()) return {0, seconds};
  if (asked_->automatic) choose(seconds);
  resize_scratch();
  std::size_t particles = 0;
  for (const Batch* b : moving_) particles += b->particles() * std::size_t(b->used);
  active_threads_ = particles >= least_shared_ ? workers_.threads() : 1;
  momenta_.clear();
  for (const ShieldPair& p : shield_.pairs) touch(p.body_a), touch(p.body_b);
  if (grab_) touch(grab_->body);
  int total = 0;
  const int fixed = fixed_substeps_.value_or(0) * integrator_->substeps;
  const int most = fixed ? fixed : integrator_->implicit ? max_implicit_steps : max_substeps;
  double surface_work = 0;
  const double most_surface_work = std::max(1e8, 1e4 * double(x_[0].size()));
  double left = seconds;
  while (left > 0 && total < most && (fixed || surface_work < most_surface_work)) {
    const int stable = fixed ? fixed - total : needed_substeps(left);
    if (has_surface_) {
      find_surface_contacts(left, left / stable);
      for (const collide::SurfacePair& p : surface_.search().pairs()) touch(p.a), touch(p.b);
    }
    const int rate = fixed ? stable : int(std::min(most_substeps, std::ceil(left * surface_.rate())));
    int count = std::max(stable, rate);
    if (count >= most_substeps) count = 1;  // the sooner its frame ends, the sooner it is seen
    // A matrix belongs to a step length, of which there are to be few: halves, quarters, ... of a frame.
    if (integrator_->implicit && !fixed) {
      count = std::min(count, 1 << 20);  // far more than there may be, and lengths still divide what is left
      double length = seconds;
      const auto fits = [&] { return std::abs(left / length - std::round(left / length)) < 1e-6; };
      while (length > left * (1 + 1e-9) || left / length < count * (1 - 1e-9) || !fits()) length /= 2;
      count = int(std::lround(left / length));
    }
    if (total == 0 && !integrator_->implicit && count >= many_substeps) note_momenta();
    const double h = left / count;
    const auto go_on = [&](int steps) {
      run(steps, static_cast<float>(h), total == 0, after_substep);
      total += steps;
    };
    int now = fixed ? count : std::clamp(substeps_within_bound(h), 1, count);
    // Then it is looked whether the candidates still hold: at once where their speed decides the count.
    if (!surface_.empty()) now = std::min(now, fixed || count > stable ? 1 : 4);
    if (has_surface_) now = std::min(now, foreseen_substeps(left, h));
    now = std::min(now, most - total);
    const int before = total;
    if (total == 0 && now > 1 && !fixed) {
      go_on(1);  // what pulls at bodies that were moved by hand, or let go, shows in their speed only then
      now = std::min(now, 1 + substeps_within_bound(h));
    }
    if (now > total - before) go_on(now - (total - before));
    left = now == count ? 0 : left - now * h;
    if (!surface_.empty()) surface_work += double(surface_.search().features().size()) * now;
  }
  keep_momenta(seconds - left);
  return {total, seconds - left};
}

/// How many substeps of h seconds the bound of substeps() may be trusted for: it is worked out anew before the fastest
/// body has moved a fifth of its radius, for a body that is being crushed gets stiffer, or about a quarter of the
/// shield's thickness, for a contact that is being pressed damps more.
int Dynamics::substeps_within_bound(double h) const {
  constexpr double most = 16;
  double trusted = most;
  for (const Batch* b : moving_) {
    const double radius = b->prototype->radius, pressed = std::max(0.25 * double(shield_.thickness), 0.05 * radius);
    const double way = shield_.pairs.empty() ? 0.2 * radius : std::min(pressed, 0.2 * radius);
    trusted = std::min(trusted, way / (fastest(*b) * h));
  }
  return static_cast<int>(trusted);
}

void Dynamics::run(int count, float h, bool first, const std::function<void()>& after_substep) {
  step_ = h;
  if (integrator_->implicit) prepare_implicit(h);
  const auto task = [&](int thread) {
    for (int s = 0; s < count; ++s) {
      if (has_restitution_)
        for (Batch* b : share(thread))
          for (std::size_t k = 0; k < 3; ++k)
            std::copy_n(v_[k].begin() + std::ptrdiff_t(b->base), b->values(),
                        before_[k].begin() + std::ptrdiff_t(b->base));
      integrator_->advance(*this, thread, {h, first && s == 0});
      if (has_surface_) since_found_[std::size_t(thread)] += h;
      if (!after_substep) continue;
      barrier();
      if (thread == 0) after_substep();
      barrier();
    }
  };
  if (active_threads_ == 1)
    task(0);
  else
    workers_.run(task);
}

std::span<Batch* const> Dynamics::share(int thread) const {
  const auto [begin, end] = collide::part_of(moving_.size(), thread, active_threads_);
  return std::span(moving_).subspan(begin, end - begin);
}

void Dynamics::barrier() {
  if (active_threads_ > 1) workers_.barrier();
}

void Dynamics::contact_forces(int thread, float h) {
  if (shield_.pairs.empty()) return;
  shield_.evaluate(collide::part_of(shield_.pairs.size(), thread, active_threads_),
                   {x_[0].data(), x_[1].data(), x_[2].data()}, {v_[0].data(), v_[1].data(), v_[2].data()}, h);
  barrier();
}

void Dynamics::contacts(int thread, float h, float since_start) {
  surface_contacts(thread, h, since_start);
  solids(thread, h);
  for (int turn = 0; turn < SurfaceContact::turns && has_surface_ && surface_.hit(h); ++turn) {
    barrier();
    if (!surface_.mend(thread, active_threads_, {v_[0].data(), v_[1].data(), v_[2].data()}, h, [this] { barrier(); }))
      break;
    solids(thread, h);
  }
}

void Dynamics::surface_contacts(int thread, float h, float since_start) {
  if (!has_surface_ || surface_.empty()) return;
  barrier();  // the velocities of all bodies are there
  surface_.prepare(thread, active_threads_, {x_[0].data(), x_[1].data(), x_[2].data()},
                   {v_[0].data(), v_[1].data(), v_[2].data()}, since_found_[std::size_t(thread)] + since_start, h);
  barrier();
  surface_.solve(thread, active_threads_, {x_[0].data(), x_[1].data(), x_[2].data()},
                 {v_[0].data(), v_[1].data(), v_[2].data()}, h, [this] { barrier(); });
}

void Dynamics::run_stages(Batch& b, std::span<const BatchStage> stages) {
  clear(b, softbody::forces);
  for (const BatchStage stage : stages) (this->*stage)(b);
}

void Dynamics::all_forces(Batch& b) { run_stages(b, force_stages_); }
void Dynamics::other_forces(Batch& b) { run_stages(b, other_force_stages_); }

void Dynamics::structural_springs(Batch& b) {
  kernels_of(b).springs(b.mesh->structural, at(x_, b), at(v_, b), at(f_, b));
}
void Dynamics::bend_springs(Batch& b) { kernels_of(b).springs(b.mesh->bend, at(x_, b), at(v_, b), at(f_, b)); }
void Dynamics::shear_springs(Batch& b) { kernels_of(b).springs(b.mesh->shear, at(x_, b), at(v_, b), at(f_, b)); }

void Dynamics::gas_pressure(Batch& b) {
  if (!b.prototype->has_gas) return;
  const Gas& gas = b.prototype->gas;
  alignas(32) float volume[lanes], gauge[lanes]{};
  kernels_of(b).volume(b.mesh->faces, at(x_, b), volume);
  for (int l = 0; l < b.used; ++l) gauge[l] = static_cast<float>(gas.gauge(double(volume[l])));
  kernels_of(b).pressure(b.mesh->faces, at(x_, b), gauge, at(f_, b));
}

void Dynamics::shape_matching(Batch& b) {
  if (b.mesh->shape.empty()) return;
  ShapeMoments<float> moments;
  ShapePose<float> pose{};
  kernels_of(b).shape_moments(b.mesh->shape, at(x_, b), moments);
  fit_shape(moments, b.used, pose);
  kernels_of(b).shape_pull(b.mesh->shape, pose, static_cast<float>(shape_stiffness(*b.prototype)), at(x_, b),
                           at(f_, b));
}

void Dynamics::shield_forces(Batch& b) {
  if (shield_.pairs.empty()) return;
  const auto index = static_cast<std::size_t>(&b - batches_.data());
  for (std::uint32_t e = shield_.first_end[index]; e < shield_.first_end[index + 1]; ++e) {
    const ShieldEnd& end = shield_.ends[e];
    for (std::size_t k = 0; k < 3; ++k) f_[k][end.slot] += end.sign * shield_.force[end.pair][int(k)];
  }
}

void Dynamics::kick(Batch& b, float h) {
  const glm::vec3 g = has_gravity_ ? h * glm::vec3(scene_.gravity) : glm::vec3(0.0f);
  kernels_of(b).kick({b.particles(), h / float(b.prototype->particle_mass), g.x, g.y, g.z, b.moves.data()}, at(f_, b),
                     at(v_, b));
}

void Dynamics::drift(Batch& b, float h) { kernels_of(b).drift(b.particles(), h, b.moves.data(), at(v_, b), at(x_, b)); }

}  // namespace softbody
