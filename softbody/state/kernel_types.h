#pragma once
// Arguments of the state's kernels. Narrow blocks use only the first values of arrays over lanes.

#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>

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
  float h;             // s
  float h_over_mass;   // s/kg
  float gx, gy, gz;    // h * gravity, m/s
  const float* moves;  // a value a lane, 0 or 1
};

/// Bounds of two fields, for the body in each lane.
struct Extent {
  LaneVector lo, hi;     // corners of the bounding box of the first field's vectors
  float length2[lanes];  // squared length of the longest vector of the second field ...
  float sum2[lanes];     // ... and the sum of the squares of all, which shows what is not finite: the largest need not

  double length(std::size_t lane) const { return std::sqrt(double(length2[lane])); }
  double diagonal(std::size_t lane) const {  // of the box
    const glm::dvec3 diagonal(hi[lane] - lo[lane]);
    return std::hypot(diagonal.x, diagonal.y, diagonal.z);
  }
};

/// Sums over the particles of the body in each lane. r is a particle's position relative to the first particle.
struct RigidSums {
  DoubleLaneVector place, velocity;
  DoubleLaneVector momentum;       // r x v
  DoubleLaneVector square, mixed;  // of r: xx, yy, zz and yz, zx, xy
};

/// Makes the velocities v of a lane's particles keep * v + push + spin x (r - about); r as in RigidSums.
struct RigidChange {
  float acts[lanes];  // 0 or 1
  double keep[lanes];
  DoubleLaneVector push, spin, about;  // m/s, rad/s, m

  /// Sets what happens to a lane; nothing, if numbers are not finite.
  void set(std::size_t lane, double kept, const glm::dvec3& velocity, const glm::dvec3& turn,
           const glm::dvec3& centre) {
    acts[lane] = std::isfinite(glm::dot(velocity, velocity) + glm::dot(turn, turn) + glm::dot(centre, centre));
    keep[lane] = kept;
    push.set(lane, velocity);
    spin.set(lane, turn);
    about.set(lane, centre);
  }
};

}  // namespace softbody
