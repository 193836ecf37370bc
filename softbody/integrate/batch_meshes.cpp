#include "softbody/integrate/batch_meshes.h"

namespace softbody {
namespace {

KernelSprings kernel_springs(const std::vector<Spring>& springs, Index width) {
  KernelSprings list;
  list.reserve(springs.size());
  for (const Spring& s : springs)
    list.push_back({s.i * width, s.j * width, float(s.rest), float(s.stiffness), float(s.damping)});
  return list;
}

}  // namespace

KernelMesh::KernelMesh(const BodyModel& model, int width)
    : structural(kernel_springs(model.structural, Index(width))),
      bend(kernel_springs(model.bend, Index(width))),
      shear(kernel_springs(model.shear, Index(width))) {
  const auto w = Index(width);
  faces.reserve(model.mesh.triangles.size());
  for (const auto& [i, j, k] : model.mesh.triangles) faces.push_back({i * w, j * w, k * w});
  for (const glm::dvec3& q : model.goal) shape.push_back({float(q.x), float(q.y), float(q.z)});
}

void BatchMeshes::update(const State& state) {
  of_batch_.resize(state.batches().size());
  for (const Batch& b : state.batches()) {
    OfBatch& own = of_batch_[b.index];
    if (own.model == b.model && own.width == b.width) continue;
    own = {b.model, b.width, nullptr};
    for (const OfBatch& other : of_batch_)
      if (other.mesh && other.model == b.model && other.width == b.width) own.mesh = other.mesh;
    if (!own.mesh) own.mesh = std::make_shared<const KernelMesh>(*b.model, b.width);
  }
}

}  // namespace softbody
