#pragma once
// The matrices that implicit steps have used last.

#include <functional>
#include <memory>
#include <vector>

#include "softbody/integrate/implicit/matrix.h"

namespace softbody {

/// Keeps up to eight matrices of each body model, by step length. Two of them are in use at a time.
class ImplicitMatrices {
 public:
  static constexpr std::size_t max_lengths = 8;

  /// Forgets the body models that are not in use.
  void retain(const std::function<bool(const BodyModel&)>& in_use);
  /// Makes the matrix for steps of h (s), unless it is there. For a ninth step length the one that has not been
  /// prepared for longest is forgotten. Throws SceneError as ImplicitMatrix does.
  void prepare(const std::shared_ptr<const BodyModel>& model, double h);
  /// Returns the matrix for steps of h, which must be prepared.
  const ImplicitMatrix& at(const BodyModel& model, double h) const;

 private:
  struct Entry {
    std::shared_ptr<const BodyModel> model;
    double h;
    std::shared_ptr<const ImplicitMatrix> matrix;
  };
  std::vector<Entry> entries_;  // in the order in which they were prepared last
};

}  // namespace softbody
