// The law of contact on solids: for particles, a lane each (V is one value a lane), and for points of faces and edges
// between them (V is float). Compiled for each of Highway's targets, see state/simd.h.
#if defined(SOFTBODY_CONTACT_SOLID_LAW_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOFTBODY_CONTACT_SOLID_LAW_H
#undef SOFTBODY_CONTACT_SOLID_LAW_H
#else
#define SOFTBODY_CONTACT_SOLID_LAW_H
#endif

#include "softbody/contact/kernels.h"
#include "softbody/contact/law.h"

HWY_BEFORE_NAMESPACE();
namespace softbody {
namespace HWY_NAMESPACE {
namespace simd {

/// Acts on the velocity of a point: after the step it is not below the surface, the change of normal velocity acts as
/// an impulse, and friction takes at most `friction` times it from the tangential velocity. An impact is as fast as
/// the point was `before` the step's forces, because these alone may be large on a particle at rest. moves: 1, or 0 for
/// what stays as it is. Returns the change of normal velocity. Adds to `energy`, of a unit of mass, this change
/// times the speed at which an overlap is pushed out, and to `returned` what restitution gives back later.
template <class V>
HWY_INLINE V respond(const SolidArguments& s, V moves, V gap, Vec<V> n, Vec<V> before, Vec<V>& v, V& energy,
                     V& returned) {
  const V zero{}, out = law::min_speed(gap, 1.0f / s.h), normal_speed = dot(v, n), wanted = out - normal_speed;
  const V change = moves * select(wanted > V(s.slack), wanted, zero);
  if (!any_above(change, zero)) return change;
  v = v + change * n - law::within_cone(v - normal_speed * n, s.friction * change);
  energy += change * larger(out, zero);
  if (s.restitution > 0) returned += law::bounce_energy(change, dot(before, n), normal_speed + change, s.restitution);
  return change;
}

}  // namespace simd
}  // namespace HWY_NAMESPACE
}  // namespace softbody
HWY_AFTER_NAMESPACE();

#endif  // include guard
