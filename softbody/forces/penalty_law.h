#pragma once
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
// spring of stiffness k that the slip stretches, with a damper, cut off at Coulomb's limit.

#include <algorithm>
#include <cmath>

#include "softbody/contact/law.h"

namespace softbody {

template <class Real>
struct PenaltyLaw {
  Real stiffness;     // k, N/m
  Real thickness;     // h, m
  Real friction = 0;  // Coulomb's coefficient

  static constexpr Real rebound_speed = 2;   // v, m/s
  static constexpr Real approach_limit = 3;  // upper clamp of the damping factor

  /// Returns w; nothing acts where it is not positive. d2: |d|^2. T: Real or Jet.
  template <class T>
  T weight(T s, T d2) const {
    const T behind = std::min(s, T(0));
    return T(1) - (d2 - behind * behind) / T(thickness * thickness);
  }
  /// Returns F in N at u = 0.
  template <class T>
  T push_at_rest(T s, T d2) const {
    const T w = weight(s, d2);
    return w > T(0) ? T(stiffness) * w * std::min(T(thickness) - s, T(thickness)) : T(0);
  }
  /// Returns the factor of F at u.
  static Real damping(Real u) { return std::clamp(1 - damper(1) * u, Real(0), approach_limit); }
  /// Returns how fast F falls with u between the limits of that, in N s/m.
  static Real damper(Real push_at_rest) { return law::damper(push_at_rest, rebound_speed); }
  /// Returns the damper (N s/m) across n of a contact that sticks.
  Real sticking_damper() const { return Real(0.5) * damper(stiffness * thickness); }
  /// Returns how large the force can be (N) with sliding friction, or its change: Coulomb's limit moves with the push.
  Real with_friction(Real push) const { return std::sqrt(1 + friction * friction) * push; }
  /// Returns the drag that friction asks for, in N. stretch: of its spring, m; slip: m/s.
  template <class Vector>
  Vector drag(const Vector& stretch, const Vector& slip) const {
    return stiffness * stretch + sticking_damper() * slip;
  }

  /// Returns the work in J of the push at rest along n, from s until the pair is out of sight. across2: d^2 - s^2.
  Real stored(Real s, Real across2) const {
    const Real end = std::sqrt(std::max(Real(0), thickness * thickness - across2));  // of sight
    if (s >= end || end == 0) return 0;
    const auto push = [&](Real at) { return push_at_rest(at, across2 + at * at); };
    const Real from = std::max(s, Real(0));
    // Simpson's rule is exact for a cubic. Behind the surface the push does not change.
    return (end - from) / 6 * (push(from) + 4 * push((from + end) / 2) + push(end)) + (from - s) * push(0);
  }
  /// Returns the energy in J that a friction spring holds, by its stretch squared.
  Real stored_by_friction(Real stretch2) const { return stiffness / 2 * stretch2; }

  /// Returns an upper bound of how fast F falls with s (N/m): the weight falls, too, by 2 s / h^2 times a depth of
  /// h - s, together at most a half.
  Real slope_bound(Real s, Real d2, Real u) const { return stiffness * damping(u) * (weight(s, d2) + Real(0.5)); }
  /// Returns the same in N s/m for how the force falls with the velocity.
  Real damping_bound(Real push_at_rest) const {
    return std::max(sticking_damper(), with_friction(damper(push_at_rest)));
  }

  // Upper bounds wherever the pair is; k may be what all contacts of a particle share.
  /// In N/m. The push falls fastest at s = h/3, by 4/3 k; the friction spring adds k.
  static Real stiffness_bound(Real k) { return (Real(4) / 3 * approach_limit + 1) * k; }
  Real damping_bound() const { return damping_bound(stiffness * thickness); }               // N s/m
  Real max_force() const { return with_friction(approach_limit * stiffness * thickness); }  // N
};

}  // namespace softbody
