// The law of penalty contact. "A tolerance force that acts like a shield" is the paper's (§2.3); its law is ours: along
// a unit normal n, fixed for a frame, two particles with separation d push each other apart by
//
//   F = k w min(h - s, h) clamp(1 - u / v, 0, 3)    s = d . n,  w = 1 - (d^2 - s_^2) / h^2,  s_ = min(s, 0),
//
// which fades out where the detector loses sight of the pair, at |d| = h, so that contacts come and go without a jump -
// in front of the surface. A pair that comes into sight from behind it is pushed out with full force at once: work that
// nobody has put in, as when solids push out what is in them.
// h is the thickness of the contact layer, k its stiffness, u the speed at which the two separate: Hunt and Crossley's
// damping (1975), under which nothing is thrown back faster than v. Friction across n is Cundall and Strack's (1979): a
// spring of stiffness k that the slip stretches, with a damper, cut off at Coulomb's limit. Both dampers can have a
// limit, which leaves the push at rest alone. Compiled for each of Highway's targets, see state/simd.h.
#if defined(SOFTBODY_FORCES_PENALTY_LAW_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOFTBODY_FORCES_PENALTY_LAW_H
#undef SOFTBODY_FORCES_PENALTY_LAW_H
#else
#define SOFTBODY_FORCES_PENALTY_LAW_H
#endif

#include <limits>

#include "softbody/contact/law.h"

HWY_BEFORE_NAMESPACE();
namespace softbody {
namespace HWY_NAMESPACE {

/// The law of one pair; with floats of all lanes for V, of one pair in each lane. V: a float or double, or such floats.
template <class V>
struct PenaltyLaw {
  using Real = simd::Value<V>;
  V stiffness;                                           // k, N/m
  V thickness;                                           // h, m
  V friction = Real(0);                                  // Coulomb's coefficient
  V max_damper = std::numeric_limits<Real>::infinity();  // N s/m

  static constexpr Real rebound_speed = 2;   // v, m/s
  static constexpr Real approach_limit = 3;  // upper clamp of the damping factor

  /// Returns w; nothing acts where it is not positive. d2: |d|^2.
  HWY_INLINE V weight(V s, V d2) const {
    const V behind = simd::smaller(s, V(0));
    return V(1) - (d2 - behind * behind) / (thickness * thickness);
  }
  /// Returns F in N at u = 0.
  HWY_INLINE V push_at_rest(V s, V d2) const {
    const V w = weight(s, d2);
    return simd::select(w > V(0), stiffness * w * simd::smaller(thickness - s, thickness), V(0));
  }
  /// Returns the factor of F at u.
  HWY_INLINE V damping(V u) const { return clamp(V(1) - damper(V(1)) * u, V(0), V(approach_limit)); }
  /// Returns F at u, from that at u = 0.
  HWY_INLINE V push(V at_rest, V u) const {
    return at_rest + clamp(-simd::smaller(damper(at_rest), max_damper) * u, -at_rest, V(approach_limit - 1) * at_rest);
  }
  /// Returns how fast F falls with u between the limits of that if the damper has no limit, in N s/m.
  HWY_INLINE V damper(V push_at_rest) const { return law::damper(push_at_rest, V(rebound_speed)); }
  /// Returns the damper (N s/m) across n of a contact that sticks.
  HWY_INLINE V sticking_damper() const {
    return simd::smaller(V(Real(0.5)) * law::damper(stiffness * thickness, V(rebound_speed)), max_damper);
  }

  /// Returns the force (N) on the particle that the other one is d away from, against n. velocity: d's, m/s. `stretch`
  /// (m) of the friction spring grows by the slip of `seconds`, as far as friction holds.
  template <class Vector>
  HWY_INLINE Vector force(const Vector& d, const Vector& velocity, const Vector& normal, V seconds,
                          Vector& stretch) const {
    const V at_rest = push_at_rest(dot(d, normal), dot(d, d)), u = dot(velocity, normal), pushed = push(at_rest, u);
    const Vector slip = velocity - u * normal, stretched = stretch + seconds * slip;
    const Vector asked = stiffness * stretched + sticking_damper() * slip;
    const V limit = friction * pushed;
    const Vector drag = law::within_cone(asked, limit), none{V(0), V(0), V(0)};
    const auto slides = simd::square_root(dot(asked, asked)) > limit, acts = at_rest > V(0);
    stretch = select(acts, select(slides, (V(1) / stiffness) * drag, stretched), none);
    return select(acts, pushed * normal - drag, none);
  }

  /// Returns the work in J of the push at rest along n, from s until the pair is out of sight. across2: d^2 - s^2.
  HWY_INLINE V stored(V s, V across2) const {
    const V end = simd::square_root(simd::larger(thickness * thickness - across2, V(0)));  // of sight
    const V from = simd::larger(s, V(0)), way = simd::larger(end - from, V(0));
    const V at_start = push_at_rest(from, across2 + from * from);
    const V middle = from + way / V(2), at_middle = push_at_rest(middle, across2 + middle * middle);
    // Simpson's rule is exact for a cubic, which ends at 0. Behind the surface the push does not change.
    return way / V(6) * (at_start + V(4) * at_middle) + (from - s) * at_start;
  }
  /// Returns the energy in J that a friction spring holds, by its stretch squared.
  HWY_INLINE V stored_by_friction(V stretch2) const { return stiffness / V(2) * stretch2; }

  /// Returns an upper bound of how fast F falls with s (N/m): the weight falls, too, by 2 s / h^2 times a depth of
  /// h - s, together at most a half.
  HWY_INLINE V slope_bound(V s, V d2, V u) const { return stiffness * damping(u) * (weight(s, d2) + V(Real(0.5))); }

  // Upper bounds wherever the pair is; k may be what all contacts of a particle share.
  /// In N/m, along any direction. The push falls fastest at s = h/3, by 4/3 k. The friction spring acts across n, by k.
  static HWY_INLINE V stiffness_bound(V k) { return V(Real(4) / 3 * approach_limit) * k; }
  /// Returns how large the force can be (N) with sliding friction: Coulomb's limit moves with the push.
  HWY_INLINE V max_force() const {
    return simd::square_root(V(1) + friction * friction) * V(approach_limit) * stiffness * thickness;
  }

 private:
  static HWY_INLINE V clamp(V v, V low, V high) { return simd::smaller(simd::larger(v, low), high); }
};

}  // namespace HWY_NAMESPACE
}  // namespace softbody
HWY_AFTER_NAMESPACE();

#endif  // include guard
