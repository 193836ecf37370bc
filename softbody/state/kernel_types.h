#pragma once
// What the kernels of the state take. Of what stands here for each lane, a body that is solved by itself has but the
// first value.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "softbody/state/lanes.h"

namespace softbody {

struct LaneVector {
  alignas(32) float x[lanes], y[lanes], z[lanes];
};

struct DoubleLaneVector {
  alignas(64) double x[lanes], y[lanes], z[lanes];
};

struct KickArguments {
  std::size_t particles;
  float h_over_mass;   // s/kg
  float gx, gy, gz;    // h * gravity, m/s
  const float* moves;  // a value a lane, 0 or 1
};

/// Of a body a lane.
struct Extent {
  LaneVector lo, hi;                 // corners of the box round one field's vectors
  alignas(32) float length2[lanes];  // squared length of the longest vector of another

  double max_length() const { return std::sqrt(double(*std::max_element(std::begin(length2), std::end(length2)))); }
  double max_diagonal() const {  // of the boxes' diagonals
    double most = 0;
    for (int l = 0; l < lanes; ++l)
      most =
          std::max(most, std::hypot(double(hi.x[l] - lo.x[l]), double(hi.y[l] - lo.y[l]), double(hi.z[l] - lo.z[l])));
    return most;
  }
};

/// Of a lane's body: sums over its particles, with their places r seen from the first one.
struct RigidSums {
  DoubleLaneVector place, velocity;
  DoubleLaneVector momentum;       // r x v
  DoubleLaneVector square, mixed;  // of r: xx, yy, zz and yz, zx, xy
};

/// What is added to the velocities of the lanes in which `acts` is 1: push + spin x (r - about), r as in RigidSums.
struct RigidChange {
  alignas(32) float acts[lanes];       // 0 or 1
  DoubleLaneVector push, spin, about;  // m/s, rad/s, m
};

}  // namespace softbody
