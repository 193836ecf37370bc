// Dynamics: the plain arithmetic on its fields that integrators ask for, and how they are saved.

#include <algorithm>

#include "softbody/integrate/dynamics.h"
#include "softbody/state/kernels.h"

namespace softbody {

Dynamics::Components& Dynamics::components(Quantity q) {
  Components* const own[] = {&x_, &v_, &f_};
  return q.index < 3 ? *own[q.index] : scratch_[std::size_t(q.index - 3)];
}

void Dynamics::copy(Batch& b, Quantity from, Quantity to) {
  state_kernels(b.width).copy(b.used, b.particles(), b.moves.data(), at(components(from), b), at(components(to), b));
}

void Dynamics::add(Batch& b, Quantity to, float times, Quantity q) {
  state_kernels(b.width).add(b.used, b.particles(), b.moves.data(), times, at(components(q), b), at(components(to), b));
}

void Dynamics::scale(Batch& b, Quantity q, float times) {
  state_kernels(b.width).scale(b.used, b.particles(), b.moves.data(), times, at(components(q), b));
}

void Dynamics::clear(Batch& b, Quantity q) {
  state_kernels(b.width).clear(b.used, b.particles(), at(components(q), b));
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
