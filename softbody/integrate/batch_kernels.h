#pragma once
// The kernels for each batch.

#include "softbody/integrate/kernels.h"
#include "softbody/state/state.h"

namespace softbody {

class BatchKernels {
 public:
  explicit BatchKernels(Isa isa) : isa_(isa), wide_(kernels(isa, lanes)), narrow_(kernels(isa, one_lane)) {}

  Isa isa() const { return isa_; }
  const Kernels& operator()(const Batch& batch) const { return batch.width == one_lane ? narrow_ : wide_; }
  /// Returns the bounds of `boxed`, and the length of the longest vector of `measured`, for each body of a batch.
  Extent extent(const Batch& batch, const VectorArray& boxed, const VectorArray& measured) const;
  /// Returns the largest speed (m/s) of a batch's particles.
  double max_particle_speed(const State& state, const Batch& batch) const {
    return extent(batch, state.x, state.v).max_length();
  }

 private:
  Isa isa_;
  const Kernels &wide_, &narrow_;
};

/// A batch with its positions and velocities, and the kernels of its width.
struct BatchView {
  const Batch& batch;
  const Kernels& kernels;
  Field<float> x, v;  // m and m/s
};

}  // namespace softbody
