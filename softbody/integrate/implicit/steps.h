#pragma once
// Implicit steps of batches of bodies.

#include <map>

#include "softbody/integrate/implicit/batch.h"
#include "softbody/integrate/implicit/matrices.h"
#include "softbody/integrate/implicit/work.h"
#include "softbody/state/isa.h"

namespace softbody {

/// Takes the steps, and owns the matrices and the workspaces that they need.
class ImplicitSteps {
 public:
  explicit ImplicitSteps(Isa isa) : kernels_(implicit_kernels(isa)) {}

  /// Forgets the body models that are not in use.
  void retain(const std::function<bool(const BodyModel&)>& in_use);
  /// Gets ready for steps of h (s) of the model's bodies on threads 0 to threads - 1. Throws SceneError as
  /// ImplicitMatrix does.
  void prepare(const std::shared_ptr<const BodyModel>& model, double h, int threads);
  /// Takes a step of h, which must be prepared. Threads may take steps of different batches at the same time.
  void advance(int thread, const ImplicitBatch& batch, const ImplicitResult& result, double h);
  /// Returns the work of all threads since the last call, see ImplicitSolver::take_work().
  double take_work();

 private:
  const ImplicitKernels& kernels_;
  ImplicitMatrices matrices_;
  std::vector<std::map<std::shared_ptr<const BodyModel>, ImplicitWork>> work_;  // of each thread
};

}  // namespace softbody
