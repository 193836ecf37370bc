#pragma once
// A model's springs, faces and shape in the layout that the kernels take for each batch.

#include <memory>
#include <vector>

#include "softbody/forces/kernel_types.h"
#include "softbody/state/state.h"

namespace softbody {

/// A body model's springs, faces and shape for the kernels, shared by all its batches of one width.
struct KernelMesh {
  KernelMesh(const BodyModel& model, int width);
  KernelSprings structural, bend, shear;
  std::vector<KernelTriangle> faces;
  std::vector<ShapePoint<float>> shape;  // empty if it is not kept
};

class BatchMeshes {
 public:
  /// Follows the state after bodies have been added, removed or given another model.
  void update(const State& state);
  const KernelMesh& operator()(const Batch& batch) const { return *of_batch_[batch.index].mesh; }

 private:
  struct OfBatch {
    std::shared_ptr<const BodyModel> model;
    int width = 0;
    std::shared_ptr<const KernelMesh> mesh;
  };
  std::vector<OfBatch> of_batch_;
};

}  // namespace softbody
