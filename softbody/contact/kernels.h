#pragma once
// The inner loop of contact with solids, over the particles of one batch. Vectorised with Highway, which chooses the
// processor's instruction set at run time; the result is the same on every one.

#include <cstddef>

#include "softbody/contact/solid_geometry.h"
#include "softbody/state/kernel_types.h"

namespace softbody {

/// What solids do to the body in each lane is added here.
struct SolidSums {
  Field<float> impulse;  // N s, along their normals
  float* returned;       // J, that restitution gives back
  float* energy;         // J, that pushing out gives
};

/// A solid seen from each body's own origin.
struct SolidArguments {
  std::size_t particles;
  float mass;                   // kg, of one particle
  float friction, restitution;  // the latter with the material
  SolidShape<float> shape;      // grown by the thickness that particles keep from it
  LaneVector place;             // m, see the shape
  const float* moves;
  SolidSums sums;
  float h = 0;                  // s
  float slack = 0;              // m/s: a smaller change of normal velocity is left undone
  Field<const float> before{};  // velocities at the start of the step; read only if there is restitution
  unsigned near = ~0u;          // bits: lanes on which it acts, whose bodies may meet it in the frame at hand
};

/// Acts on the velocities v of the first `used` lanes. Returns the lanes in which the solid acted, as bits.
unsigned act_by_solid(int width, std::size_t used, const SolidArguments& solid, Field<const float> x, Field<float> v);

}  // namespace softbody
