#include "softbody/integrate/motion.h"
#include "softbody/integrate/force_stage.h"

#include <algorithm>
#include <utility>

namespace softbody {

void Motion::set_plan(const Plan& plan) {
  ForceMask taken;
  for_each_force(Forces{}, [&]<class F>(Name<F>) { taken[index_of<F>] = plan.has(stage_of<F>); });
  forces_.set_plan(taken);
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

void Motion::all_forces(const Batch& b) {
  clear(b, forces);
  forces_.add(step_of(b, h_));
}

void Motion::other_forces(const Batch& b) {
  clear(b, forces);
  forces_.add_unprojected(step_of(b, h_));
}

void Motion::project(const Batch& b, Quantity x0, Quantity d, float h) {
  forces_.project(step_of(b, h), field(std::as_const(array(x0)), b.base), field(array(d), b.base));
}

void Motion::pull(const Batch& b, float h) { forces_.kick(step_of(b, h)); }

void Motion::kick(const Batch& b, float h) {
  const glm::vec3 g = h * glm::vec3(gravity_);
  parts_.kernels(b).kick({b.particles(), h / float(b.model->particle_mass), g.x, g.y, g.z, b.moves.data()}, f(b), v(b));
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
