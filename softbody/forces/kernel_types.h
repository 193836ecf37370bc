#pragma once
// What the kernels of forces take. Of what stands here for each lane, a body that is solved by itself has but the first
// value.

#include <array>
#include <cstdint>
#include <vector>

#include "softbody/state/lanes.h"

namespace softbody {

/// A spring as the loops want it: particle indices already times the width of the batch, single precision.
template <class Real>
struct KernelSpring {
  std::uint32_t i, j;
  Real rest, stiffness, damping;
};

template <class Real>
using KernelSpringsOf = std::vector<KernelSpring<Real>>;
using KernelSprings = KernelSpringsOf<float>;

/// Corners of a face, already times the width of the batch.
using KernelTriangle = std::array<std::uint32_t, 3>;

/// A particle's place in the shape that a body keeps, from the mean of all; see shape_matching.h.
template <class Real>
struct ShapePoint {
  Real x, y, z;
};

/// Of each lane's body: the mean of x, and the sum of x q^T, q the places of ShapePoint; column c of the matrix at 3 c.
template <class Real>
struct ShapeMoments {
  alignas(64) Real mean[3][lanes], covariance[9][lanes];
};

/// Where the shape is to go: x = centre + rotation q; column c of the rotation at 3 c.
template <class Real>
struct ShapePose {
  alignas(64) Real centre[3][lanes], rotation[9][lanes];
};

struct ProjectArguments {
  float h;             // s
  float inverse_mass;  // 1/kg, of a particle
  const float* moves;  // a value a lane, 0 or 1
};

}  // namespace softbody
