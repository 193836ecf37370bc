// Dynamics: the plain arithmetic on its fields that integrators ask for, and how they are saved.

#include <algorithm>

#include "softbody/integrate/dynamics.h"

namespace softbody {

Dynamics::Components& Dynamics::components(Quantity q) {
  Components* const own[] = {&x_, &v_, &f_};
  return q.index < 3 ? *own[q.index] : scratch_[std::size_t(q.index - 3)];
}

/// operation(place in the arrays, 1 or 0 for whether its lane moves)
template <class Operation>
void Dynamics::each_value(Batch& b, Operation operation) {
  const auto run = [&, moves = b.moves](auto width) {
    for (std::size_t at = b.base; at < b.base + b.values(); at += width)
      for (std::size_t l = 0; l < width; ++l) operation(at + l, moves[l]);
  };
  if (b.width == one_lane)
    run(std::integral_constant<std::size_t, one_lane>());
  else
    run(std::integral_constant<std::size_t, lanes>());
}

void Dynamics::copy(Batch& b, Quantity from, Quantity to) {
  for (std::size_t k = 0; k < 3; ++k) {
    const float* source = components(from)[k].data();
    float* target = components(to)[k].data();
    each_value(b, [=](std::size_t i, float moves) { target[i] = moves > 0 ? source[i] : target[i]; });
  }
}

void Dynamics::add(Batch& b, Quantity to, float times, Quantity q) {
  for (std::size_t k = 0; k < 3; ++k) {
    const float* source = components(q)[k].data();
    float* target = components(to)[k].data();
    each_value(b, [=](std::size_t i, float moves) { target[i] += moves > 0 ? times * source[i] : 0; });
  }
}

void Dynamics::scale(Batch& b, Quantity q, float times) {
  for (std::size_t k = 0; k < 3; ++k) {
    float* target = components(q)[k].data();
    each_value(b, [=](std::size_t i, float moves) { target[i] *= moves > 0 ? times : 1; });
  }
}

void Dynamics::clear(Batch& b, Quantity q) {
  for (auto& c : components(q)) std::fill_n(c.begin() + std::ptrdiff_t(b.base), b.values(), 0.0f);
}

void Dynamics::accelerations(Batch& b) {
  const auto inverse_mass = float(1 / b.model->particle_mass);
  for (std::size_t k = 0; k < 3; ++k) {
    const float g = has_gravity_ ? float(scene_.gravity[int(k)]) : 0;
    float* f = f_[k].data();
    each_value(b, [=](std::size_t i, float) { f[i] = f[i] * inverse_mass + g; });
  }
}

std::size_t DynamicsState::bytes() const {
  std::size_t sum = bytes_of(batches) + bytes_of(bodies) + bytes_of(penalty_pairs) + surface.bytes();
  for (const auto* components : {&x, &v})
    for (const auto& c : *components) sum += bytes_of(c);
  return sum;
}

DynamicsState Dynamics::save() const {
  DynamicsState state{batches_,           bodies_, x_, v_, penalty_.thickness, penalty_.pairs, surface_.save(),
                      substep_hysteresis_};
  for (Batch& b : state.batches) {  // for one frame only, and they point into the batch that they were copied from
    b.near_solids.clear();
    b.solid_features.clear();
  }
  return state;
}

void Dynamics::restore(const DynamicsState& state) {
  batches_ = state.batches;
  bodies_ = state.bodies;
  x_ = state.x;
  v_ = state.v;
  for (auto& c : f_) c.resize(x_[0].size());
  penalty_.thickness = state.penalty_thickness;
  penalty_.pairs = state.penalty_pairs;
  surface_.restore(state.surface);
  substep_hysteresis_ = state.substep_hysteresis;
  crew_.take({}, 0);
}

}  // namespace softbody
