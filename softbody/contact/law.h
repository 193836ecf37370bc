// The law of contact, for everything that touches: solids, surfaces, penalty contact and implicit steps. V is float,
// double or floats of all lanes, T the type of one value of it. app/reference has the law once more on purpose, because
// it checks this one. Compiled for each of Highway's targets, see state/simd.h.
#if defined(SOFTBODY_CONTACT_LAW_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOFTBODY_CONTACT_LAW_H
#undef SOFTBODY_CONTACT_LAW_H
#else
#define SOFTBODY_CONTACT_LAW_H
#endif

#include <algorithm>
#include <cmath>

#include "softbody/state/simd.h"

HWY_BEFORE_NAMESPACE();
namespace softbody {
namespace HWY_NAMESPACE {
namespace law {

/// Overlaps are pushed out by this share of their depth in a step ...
inline constexpr double push_share = 0.1;
/// ... but no faster than this.
inline constexpr double max_separation_speed = 1;  // m/s
/// Of slower impacts nothing is given back, so that resting contacts rest.
inline constexpr double impact_speed = 0.5;  // m/s

/// Returns the least change of a gap in one step, in a unit of which a metre has `per_metre`: a gap may close but not
/// turn into an overlap; an overlap (a negative gap) becomes smaller, by `most` at most.
template <class V, class T>
HWY_INLINE V min_change(V gap, T per_metre, T most) {
  return simd::select(gap > V(0), -gap * per_metre, simd::smaller(-T(push_share) * per_metre * gap, V(most)));
}

/// Returns how far (m) two sides have to separate in a step of h, at least; negative: they may approach.
template <class V, class T>
HWY_INLINE V min_move(V gap, T h) {
  return min_change(gap, T(1), T(max_separation_speed) * h);
}

/// Returns how fast (m/s) they have to separate, from 1 / h.
template <class V, class T>
HWY_INLINE V min_speed(V gap, T inverse_h) {
  return min_change(gap, inverse_h, T(max_separation_speed));
}

/// Returns what an impulse (N s) that changes a speed from `before`, in a step, to `after` (m/s) takes of the energy,
/// and gives back when the two sides part.
template <class V, class T>
HWY_INLINE V bounce_energy(V impulse, V before, V after, T restitution) {
  return -T(0.5) * restitution * restitution * impulse * (before + after);
}

/// Returns the damper (N s/m) that a contact of this force (N) acts with, after Hunt and Crossley (1975): nothing is
/// thrown back faster than `rebound_speed`.
template <class T>
T damper(T force, T rebound_speed) {
  return force / rebound_speed;
}

/// Returns `drag`, shortened to `limit` where it is longer (Coulomb's cone): to nothing where the limit is 0.
template <class Vector, class V>
HWY_INLINE Vector within_cone(const Vector& drag, V limit) {
  const V size = simd::square_root(dot(drag, drag));
  return (simd::smaller(limit, size) / simd::select(size > V(0), size, V(1))) * drag;
}

/// Returns the coefficient of friction between two materials.
template <class T>
T common_friction(T a, T b) {
  return std::sqrt(a * b);
}

/// Returns the restitution between two materials, or of a material on a solid.
template <class T>
T common_restitution(T a, T b) {
  return std::max(a, b);
}

}  // namespace law
}  // namespace HWY_NAMESPACE
}  // namespace softbody
HWY_AFTER_NAMESPACE();

#endif  // include guard
