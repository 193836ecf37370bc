#pragma once
// The law of contact on solids: for particles, a lane each (V is one value a lane), and for points of faces and edges
// between them (V is float).

#include "softbody/contact/law.h"
#include "softbody/contact/solid_shapes.h"
#include "softbody/state/kernel_types.h"

namespace softbody {

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
/// an impulse, and friction takes at most `friction` times it from the tangential velocity. An impact is as fast as
/// the point was before the step's forces, because these alone may be large on a particle at rest. moves: 1, or 0 for
/// what stays as it is. Returns the change of normal velocity.
template <class V>
SB_INLINE V respond(const SolidArguments& s, V moves, V gap, Vec<V> n, Vec<V> before, Vec<V>& v) {
  const V zero{};
  V target = law::min_speed(gap, 1.0f / s.h);
  const V normal_speed = dot(v, n);
  if (s.restitution > 0) {
    const V thrown_back = larger(law::rebound(-dot(before, n), s.restitution), target);
    target = normal_speed < target ? thrown_back : target;
  }
  const V wanted = target - normal_speed;
  const V change = moves * (wanted > s.slack ? wanted : zero);
  if (!any_above(change, zero)) return change;
  v = v + change * n - law::within_cone(v - normal_speed * n, s.friction * change);
  return change;
}

}  // namespace body
}  // namespace softbody
