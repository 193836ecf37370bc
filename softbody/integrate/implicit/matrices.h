#pragma once
// The matrices that implicit steps have used last.

#include <memory>
#include <vector>

#include "softbody/integrate/implicit/matrix.h"

namespace softbody {

/// Keeps up to eight matrices of one body model, by step length. Two of them are in use at a time.
class ImplicitMatrices {
 public:
  static constexpr std::size_t max_lengths = 8;

  /// Makes the matrix for steps of h (s), unless it is there. For a ninth step length the one that has not been
  /// prepared for longest is forgotten. Throws SceneError as ImplicitMatrix does.
  void prepare(const BodyModel& model, double h);
  /// Returns the matrix for steps of h, which must be prepared.
  const ImplicitMatrix& at(double h) const;

 private:
  struct Entry {
    double h;
    std::unique_ptr<const ImplicitMatrix> matrix;
  };
  std::vector<Entry> entries_;  // in the order in which they were prepared last
};

}  // namespace softbody
