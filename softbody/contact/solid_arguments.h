#pragma once
// Shapes of solids without their places, as kernels want them. Points are seen from: a sphere's or box's centre, any
// point of a plane, `from` of a capsule.

#include <variant>

#include <glm/vec3.hpp>

#include "softbody/state/kernel_types.h"

namespace softbody {

template <class Real>
struct SphereShape {
  Real radius;
};
template <class Real>
struct PlaneShape {
  glm::vec<3, Real> normal;
};
template <class Real>
struct BoxShape {
  glm::vec<3, Real> axes[3], half_size;
  Real radius;  // of the spheres that roll over its surface: edges and corners are round
};
template <class Real>
struct CapsuleShape {
  glm::vec<3, Real> segment;  // from its one end to the other
  Real radius;
};
template <class Real>
using SolidShape = std::variant<SphereShape<Real>, PlaneShape<Real>, BoxShape<Real>, CapsuleShape<Real>>;

/// A solid seen from each body's own origin.
struct SolidArguments {
  std::size_t particles;
  float mass;                   // kg, of one particle
  float friction, restitution;  // the latter with the material
  SolidShape<float> shape;      // grown by the thickness that particles keep from it
  LaneVector place;             // m, see the shape
  const float* moves;
  Field<float> impulse;         // N s, a value a lane: the normal impulses are added here ...
  float* returned;              // ... here the energy (J) that restitution gives back ...
  float* energy;                // ... and here that which pushing out gives
  float h = 0;                  // s
  float slack = 0;              // m/s: a smaller change of normal velocity is left undone
  Field<const float> before{};  // velocities at the start of the step; read only if there is restitution
  unsigned near = ~0u;          // bits: lanes on which it acts, whose bodies may meet it in the frame at hand
};

}  // namespace softbody
