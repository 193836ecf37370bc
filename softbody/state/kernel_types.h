#pragma once
// Arguments of the state's kernels. Narrow blocks use only the first values of arrays over lanes.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "softbody/state/lanes.h"

namespace softbody {

/// A vector for each lane.
template <class Real>
struct LaneVectorOf {
  Real x[lanes], y[lanes], z[lanes];

  glm::vec<3, Real> operator[](std::size_t lane) const { return {x[lane], y[lane], z[lane]}; }
  void set(std::size_t lane, const glm::vec<3, Real>& v) { x[lane] = v.x, y[lane] = v.y, z[lane] = v.z; }
};
using LaneVector = LaneVectorOf<float>;
using DoubleLaneVector = LaneVectorOf<double>;
template <class Real>
Field<Real> field(LaneVectorOf<Real>& v) {
  return {v.x, v.y, v.z};
}
template <class Real>
Field<const Real> field(const LaneVectorOf<Real>& v) {
  return {v.x, v.y, v.z};
}

struct KickArguments {
  std::size_t particles;
  float h_over_mass;   // s/kg
  float gx, gy, gz;    // h * gravity, m/s
  const float* moves;  // a value a lane, 0 or 1
};

/// Bounds of two fields, for the body in each lane.
struct Extent {
  LaneVector lo, hi;     // corners of the bounding box of the first field's vectors
  float length2[lanes];  // squared length of the longest vector of the second field

  double max_length() const { return std::sqrt(double(*std::max_element(std::begin(length2), std::end(length2)))); }
  double max_diagonal() const {  // of the boxes
    double most = 0;
    for (std::size_t l = 0; l < lanes; ++l) {
      const glm::dvec3 diagonal(hi[l] - lo[l]);
      most = std::max(most, std::hypot(diagonal.x, diagonal.y, diagonal.z));
    }
    return most;
  }
};

/// Sums over the particles of the body in each lane. r is a particle's position relative to the first particle.
struct RigidSums {
  DoubleLaneVector place, velocity;
  DoubleLaneVector momentum;       // r x v
  DoubleLaneVector square, mixed;  // of r: xx, yy, zz and yz, zx, xy
};

/// Velocity push + spin x (r - about) that is added to the particles of the lanes in which `acts` is 1; r as in
/// RigidSums.
struct RigidChange {
  float acts[lanes];                   // 0 or 1
  DoubleLaneVector push, spin, about;  // m/s, rad/s, m
};

}  // namespace softbody
