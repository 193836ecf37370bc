#pragma once
// The kernels for each batch, and its model's springs, faces and shape in the layout that they take.

#include <memory>
#include <vector>

#include "softbody/forces/kernel_types.h"
#include "softbody/integrate/kernels.h"
#include "softbody/state/state.h"

namespace softbody {

/// A body model's springs, faces and shape for the kernels, shared by all its batches of one width.
struct KernelMesh {
  KernelMesh(const BodyModel& model, int width);
  KernelSprings structural, bend, shear;
  std::vector<KernelTriangle> faces;
  std::vector<ShapePoint<float>> shape;  // empty if it is not kept
};

class BatchKernels {
 public:
  explicit BatchKernels(Isa isa) : wide_(kernels(isa, lanes)), narrow_(kernels(isa, one_lane)) {}

  /// Follows the state after bodies have been added, removed or given another model.
  void update(const State& state);
  const Kernels& operator()(const Batch& batch) const { return batch.width == one_lane ? narrow_ : wide_; }
  const KernelMesh& mesh(const Batch& batch) const { return *of_batch_[batch.index].mesh; }
  /// Returns the bounds of `boxed`, and the length of the longest vector of `measured`, for each body of a batch.
  Extent extent(const Batch& batch, const VectorArray& boxed, const VectorArray& measured) const;
  /// Returns the largest speed (m/s) of a batch's particles.
  double max_particle_speed(const State& state, const Batch& batch) const {
    return extent(batch, state.x, state.v).max_length();
  }

 private:
  struct OfBatch {
    std::shared_ptr<const BodyModel> model;
    int width = 0;
    std::shared_ptr<const KernelMesh> mesh;
  };
  const Kernels &wide_, &narrow_;
  std::vector<OfBatch> of_batch_;
};

/// A batch with its positions and velocities, and the kernels of its width.
struct BatchView {
  const Batch& batch;
  const Kernels& kernels;
  Field<float> x, v;  // m and m/s
};

}  // namespace softbody
