#include "softbody/integrate/motion.h"

#include <algorithm>
#include <utility>

#include "softbody/forces/shape_matching.h"

namespace softbody {

void Motion::set_plan(const Plan& plan) {
  static constexpr std::pair<Stage, ForceStage> springs_and_gas[] = {
      {Stage::structural_springs, &Motion::structural_springs},
      {Stage::bend_springs, &Motion::bend_springs},
      {Stage::shear_springs, &Motion::shear_springs},
      {Stage::gas_pressure, &Motion::gas_pressure},
  };
  static constexpr std::pair<Stage, ForceStage> others[] = {
      {Stage::shape_matching, &Motion::shape_matching},
      {Stage::contact_response, &Motion::penalty_forces},
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
  if (plan.has(Stage::grab)) force_stages_.push_back(&Motion::hand_force);  // last: it reckons with the others
}

void Motion::begin_frame(int scratch, const glm::dvec3& gravity) {
  gravity_ = gravity;
  scratch_.resize(std::size_t(scratch));
  for (auto& one : scratch_)
    for (auto& c : one) c.resize(parts_.state.x[0].size());
}

void Motion::contact_forces(const Worker& worker, float h) {
  PenaltyContact& penalty = parts_.penalty;
  if (penalty.pairs.empty()) return;
  penalty.evaluate(worker.part(penalty.pairs.size()), field(parts_.state.x), field(parts_.state.v), h);
  worker.barrier();
}

void Motion::run_stages(const Batch& b, std::span<const ForceStage> stages) {
  clear(b, forces);
  for (const ForceStage stage : stages) (this->*stage)(b);
}

void Motion::all_forces(const Batch& b) { run_stages(b, force_stages_); }
void Motion::other_forces(const Batch& b) { run_stages(b, other_force_stages_); }

void Motion::structural_springs(const Batch& b) {
  parts_.kernels(b).springs(parts_.kernels.mesh(b).structural, x(b), v(b), f(b));
}
void Motion::bend_springs(const Batch& b) { parts_.kernels(b).springs(parts_.kernels.mesh(b).bend, x(b), v(b), f(b)); }
void Motion::shear_springs(const Batch& b) {
  parts_.kernels(b).springs(parts_.kernels.mesh(b).shear, x(b), v(b), f(b));
}

void Motion::gas_pressure(const Batch& b) {
  if (!b.model->has_gas) return;
  const Gas& gas = b.model->gas;
  const KernelMesh& mesh = parts_.kernels.mesh(b);
  alignas(32) float volume[lanes], gauge[lanes]{};
  parts_.kernels(b).volume(mesh.faces, x(b), volume);
  for (int l = 0; l < b.used; ++l) gauge[l] = static_cast<float>(gas.gauge(double(volume[l])));
  parts_.kernels(b).pressure(mesh.faces, x(b), gauge, f(b));
}

void Motion::shape_matching(const Batch& b) {
  const KernelMesh& mesh = parts_.kernels.mesh(b);
  if (mesh.shape.empty()) return;
  ShapeMoments<float> moments;
  ShapePose<float> pose{};
  parts_.kernels(b).shape_moments(mesh.shape, x(b), moments);
  fit_shape(moments, b.used, pose);
  parts_.kernels(b).shape_pull(mesh.shape, pose, static_cast<float>(shape_stiffness(*b.model)), x(b), f(b));
}

void Motion::penalty_forces(const Batch& b) {
  const PenaltyContact& penalty = parts_.penalty;
  for (const PenaltyEnd& end : penalty.ends_of(b))
    for (std::size_t k = 0; k < 3; ++k) parts_.state.f[k][end.slot] += end.sign * penalty.force[end.pair][int(k)];
}

bool Motion::has_hand(const Batch& b) const {
  const auto& grab = parts_.hand.grab();
  return grab && parts_.state.body(grab->body).batch == b.index;
}

HeldBody Motion::held_body() {
  State& s = parts_.state;
  const BodyId id = parts_.hand.grab()->body;
  return {s.model(id), s.body(id).origin, s.field_of(id, s.x), s.field_of(id, s.v), s.field_of(id, s.f)};
}

void Motion::hand_force(const Batch& b) {
  if (has_hand(b)) parts_.hand.add_force(held_body(), double(h_), gravity_);
}

void Motion::pull(const Batch& b, float h) {
  if (has_hand(b)) parts_.hand.add_impulse(held_body(), double(h));
}

void Motion::kick(const Batch& b, float h) {
  const glm::vec3 g = h * glm::vec3(gravity_);
  parts_.kernels(b).kick({b.particles(), h / float(b.model->particle_mass), g.x, g.y, g.z, b.moves.data()}, f(b),
                         v(b));
}

void Motion::drift(const Batch& b, float h) {
  parts_.kernels(b).drift(b.particles(), h, b.moves.data(), v(b), field(parts_.state.x, b.base));
}

VectorArray& Motion::array(Quantity q) {
  VectorArray* const own[] = {&parts_.state.x, &parts_.state.v, &parts_.state.f};
  return q.index < 3 ? *own[q.index] : scratch_[std::size_t(q.index - 3)];
}

/// Calls operation(place in the arrays, 1 or 0 for whether its lane moves).
template <class Operation>
void Motion::each_value(const Batch& b, Operation operation) {
  const auto run = [&, moves = b.moves](auto width) {
    for (std::size_t at = b.base; at < b.base + b.values(); at += width)
      for (std::size_t l = 0; l < width; ++l) operation(at + l, moves[l]);
  };
  if (b.width == one_lane)
    run(std::integral_constant<std::size_t, one_lane>());
  else
    run(std::integral_constant<std::size_t, lanes>());
}

void Motion::copy(const Batch& b, Quantity from, Quantity to) {
  for (std::size_t k = 0; k < 3; ++k) {
    const float* source = array(from)[k].data();
    float* target = array(to)[k].data();
    each_value(b, [=](std::size_t i, float moves) { target[i] = moves > 0 ? source[i] : target[i]; });
  }
}

void Motion::add(const Batch& b, Quantity to, float times, Quantity q) {
  for (std::size_t k = 0; k < 3; ++k) {
    const float* source = array(q)[k].data();
    float* target = array(to)[k].data();
    each_value(b, [=](std::size_t i, float moves) { target[i] += moves > 0 ? times * source[i] : 0; });
  }
}

void Motion::scale(const Batch& b, Quantity q, float times) {
  for (std::size_t k = 0; k < 3; ++k) {
    float* target = array(q)[k].data();
    each_value(b, [=](std::size_t i, float moves) { target[i] *= moves > 0 ? times : 1; });
  }
}

void Motion::clear(const Batch& b, Quantity q) {
  for (auto& c : array(q)) std::fill_n(c.begin() + std::ptrdiff_t(b.base), b.values(), 0.0f);
}

void Motion::accelerations(const Batch& b) {
  const auto inverse_mass = float(1 / b.model->particle_mass);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto g = float(gravity_[int(k)]);
    float* a = parts_.state.f[k].data();
    each_value(b, [=](std::size_t i, float) { a[i] = a[i] * inverse_mass + g; });
  }
}

}  // namespace softbody
