#pragma once
// The law of contacts with solids: for particles, a lane each (V is one value a lane), and for points of faces and
// edges between them (V is float).

#include <limits>

#include "softbody/contact/solid_shapes.h"
#include "softbody/state/kernel_types.h"

namespace softbody {

/// A particle that meets a solid more slowly is not thrown back, so that resting contacts rest.
inline constexpr float impact_speed = 0.5f;  // m/s

/// A solid seen from each body's own origin.
struct SolidArguments {
  std::size_t particles;
  float mass;  // kg, of one particle
  float friction, restitution;
  SolidShape<float> shape;  // grown by the thickness that particles keep from it
  LaneVector place;         // m, see the shape
  const float* moves;
  Field<float> impulse;         // N s, a value a lane: the normal impulses are added here ...
  float* returned;              // ... and here their sizes times the restitution
  float h = 0;                  // s
  float slack = 0;              // m/s: a smaller change of normal velocity is left undone
  Field<const float> before{};  // velocities at the start of the step; read only if there is restitution
};

namespace body {

/// Acts on the velocity of a point: after the step it is not below the surface, the change of normal velocity acts as
/// an impulse, and Coulomb friction takes at most `friction` times it from the tangential velocity. What hits faster
/// than impact_speed leaves with `restitution` times its speed before the step's forces: these alone may be large on a
/// particle at rest. A point that is inside already comes out at a tenth of its depth a step, at most 1 m/s. moves: 1,
/// or 0 for what stays as it is. Returns the change of normal velocity.
template <class V>
SB_INLINE V respond(const SolidArguments& s, V moves, V gap, Vec<V> n, Vec<V> before, Vec<V>& v) {
  const V zero{};
  const float inverse_h = 1.0f / s.h;
  V target = gap > zero ? -gap * inverse_h : smaller(-0.1f * inverse_h * gap, zero + 1.0f);
  const V normal_speed = dot(v, n);
  if (s.restitution > 0) {
    const V approach = -dot(before, n);
    const V thrown_back = approach > zero + impact_speed ? larger(s.restitution * approach, target) : target;
    target = normal_speed < target ? thrown_back : target;
  }
  const V wanted = target - normal_speed;
  const V change = moves * (wanted > s.slack ? wanted : zero);
  if (!any_above(change, zero)) return change;
  const Vec<V> tangential = v - normal_speed * n;
  const V slip = square_root(dot(tangential, tangential));
  const V lost = smaller(s.friction * change, slip) / larger(slip, zero + std::numeric_limits<float>::min());
  v = v + change * n - lost * tangential;
  return change;
}

}  // namespace body
}  // namespace softbody
