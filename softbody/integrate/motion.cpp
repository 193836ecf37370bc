#include "softbody/integrate/motion.h"

#include <utility>

#include "softbody/forces/kernels.h"
#include "softbody/forces/shape_matching.h"
#include "softbody/state/kernels.h"

namespace softbody {
namespace {

std::size_t used(const Batch& b) { return std::size_t(b.used); }

}  // namespace

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
  force_kernels(b.width).springs(used(b), parts_.meshes(b).structural, x(b), v(b), f(b));
}
void Motion::bend_springs(const Batch& b) {
  force_kernels(b.width).springs(used(b), parts_.meshes(b).bend, x(b), v(b), f(b));
}
void Motion::shear_springs(const Batch& b) {
  force_kernels(b.width).springs(used(b), parts_.meshes(b).shear, x(b), v(b), f(b));
}

void Motion::gas_pressure(const Batch& b) {
  if (!b.model->has_gas) return;
  const Gas& gas = b.model->gas;
  const std::vector<KernelTriangle>& faces = parts_.meshes(b).faces;
  float volume[lanes], gauge[lanes]{};
  force_kernels(b.width).volume(used(b), faces, x(b), volume);
  for (int l = 0; l < b.used; ++l) gauge[l] = static_cast<float>(gas.gauge(double(volume[l])));
  force_kernels(b.width).pressure(used(b), faces, x(b), gauge, f(b));
}

void Motion::shape_matching(const Batch& b) {
  const KernelMesh& mesh = parts_.meshes(b);
  if (mesh.shape.empty()) return;
  ShapeMoments<float> moments;
  ShapePose<float> pose{};
  force_kernels(b.width).shape_moments(used(b), mesh.shape, x(b), moments);
  fit_shape(moments, b.used, pose);
  force_kernels(b.width).shape_pull(used(b), mesh.shape, pose, static_cast<float>(shape_stiffness(*b.model)), x(b),
                                    f(b));
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
  state_kernels(b.width).kick(
      used(b), {b.particles(), h / float(b.model->particle_mass), g.x, g.y, g.z, b.moves.data()}, f(b), v(b));
}

void Motion::accelerations(const Batch& b) {
  const glm::vec3 g(gravity_);
  state_kernels(b.width).accelerate(
      used(b), {b.particles(), float(1 / b.model->particle_mass), g.x, g.y, g.z, b.moves.data()}, f(b));
}

void Motion::drift(const Batch& b, float h) {
  state_kernels(b.width).drift(used(b), b.particles(), h, b.moves.data(), v(b), field(parts_.state.x, b.base));
}

VectorArray& Motion::array(Quantity q) {
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
  state_kernels(b.width).clear(used(b), b.particles(), field(array(q), b.base));
}

}  // namespace softbody
