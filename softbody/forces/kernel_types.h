#pragma once
// Arguments of the kernels of forces. Narrow blocks use only the first values of arrays over lanes.

#include <array>
#include <cstdint>
#include <vector>

#include "softbody/state/lanes.h"

namespace softbody {

/// A spring for the kernels: particle indices are already multiplied by the width of the batch.
template <class Real>
struct KernelSpring {
  std::uint32_t i, j;
  Real rest, stiffness, damping;
};

template <class Real>
using KernelSpringsOf = std::vector<KernelSpring<Real>>;
using KernelSprings = KernelSpringsOf<float>;

/// Corners of a face, already multiplied by the width of the batch.
using KernelTriangle = std::array<std::uint32_t, 3>;

/// A particle's place in the goal shape, relative to the mean of all; see shape_matching.h.
template <class Real>
struct ShapePoint {
  Real x, y, z;
};

/// Moments of the body in each lane: the mean of x, and the sum of x q^T with the places q of ShapePoint. Column c of
/// the matrix begins at 3 c.
template <class Real>
struct ShapeMoments {
  Real mean[3][lanes], covariance[9][lanes];
};

/// Pose of the goal shape: x = centre + rotation q. Column c of the rotation begins at 3 c.
template <class Real>
struct ShapePose {
  Real centre[3][lanes], rotation[9][lanes];
};

struct ProjectArguments {
  float h;             // s
  float inverse_mass;  // 1/kg, of a particle
  const float* moves;  // 0 or 1 for each lane
};

}  // namespace softbody
