#pragma once
// Arguments of the state's kernels. Narrow blocks use only the first values of arrays over lanes.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "softbody/state/lanes.h"

namespace softbody {

struct LaneVector {
  float x[lanes], y[lanes], z[lanes];
};

struct DoubleLaneVector {
  double x[lanes], y[lanes], z[lanes];
};

struct KickArguments {
  std::size_t particles;
  float h_over_mass;   // s/kg
  float gx, gy, gz;    // h * gravity, m/s
  const float* moves;  // a value a lane, 0 or 1
};

inline Field<float> field(LaneVector& v) { return {v.x, v.y, v.z}; }
inline Field<double> field(DoubleLaneVector& v) { return {v.x, v.y, v.z}; }
inline Field<const double> field(const DoubleLaneVector& v) { return {v.x, v.y, v.z}; }

/// Bounds of two fields, for the body in each lane.
struct Extent {
  LaneVector lo, hi;     // corners of the bounding box of the first field's vectors
  float length2[lanes];  // squared length of the longest vector of the second field

  double max_length() const { return std::sqrt(double(*std::max_element(std::begin(length2), std::end(length2)))); }
  double max_diagonal() const {  // of the boxes
    double most = 0;
    for (int l = 0; l < lanes; ++l)
      most =
          std::max(most, std::hypot(double(hi.x[l] - lo.x[l]), double(hi.y[l] - lo.y[l]), double(hi.z[l] - lo.z[l])));
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
