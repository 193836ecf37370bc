#pragma once
// Arguments of the kernels of forces. Narrow blocks use only the first values of arrays over lanes.

#include <tuple>

#include "softbody/forces/model_forces.h"
#include "softbody/mechanics/bound.h"

namespace softbody {

/// Bodies of one model side by side, the first `used` of them, and the forces on them.
template <class Real>
struct LaneBodies {
  const BodyModel& model;
  int used;
  Field<const Real> x;  // m
  Field<Real> f;        // N

  /// Returns those from a lane on.
  LaneBodies from(std::size_t lane) const { return {model, used - int(lane), x + lane, f + lane}; }
};

/// Dampers see no motion.
struct Still {};

/// Dampers see velocities.
struct Moving {
  Field<const float> v;  // m/s
};

/// Dampers see how far particles have gone since the start of an implicit step of h seconds. They act along the
/// directions that their coordinates had then, so that the damping has a potential. `carried`: how far
/// axes that move with the body carry particles that keep their places in them, in `carry_time` seconds.
struct SinceStart {
  double inverse_h;  // 1/s
  Field<const double> x, carried;
  double inverse_carry_time;  // 1/s
};

/// XPBD's displacements d in a step of h seconds that started at x0.
struct Projection {
  float h;                  // s
  const float* moves;       // 0 or 1 for each lane
  Field<const float> x0;    // m
  Field<float> d, scratch;  // m; scratch: room for as much
  const float* free;        // of each particle of each lane: 0 if it is held, else 1; nullptr: none is

  /// Returns that of the bodies from a lane on.
  Projection from(std::size_t lane) const {
    return {h, moves + lane, x0 + lane, d + lane, scratch + lane, free ? free + lane : free};
  }
};

/// Bodies of one model side by side, the first `used` of them, in double.
struct MovingBodies {
  const BodyModel& model;
  int used;
  Field<const double> x, v;  // m, m/s

  /// Returns those from a lane on.
  MovingBodies from(std::size_t lane) const { return {model, used - int(lane), x + lane, v + lane}; }
};

/// Sums over the particles of the body in each lane, and what the forces inside it store.
struct MotionSums {
  DoubleLaneVector place, velocity;       // m, m/s
  double square[lanes], fastest2[lanes];  // (m/s)^2, the sum and the largest of the squared speeds
  double volume[lanes];                   // m^3, of closed meshes
  double elastic[lanes], gas[lanes];      // J
  double growth[lanes];                   // W, how fast these two grow
  double strain[lanes];                   // the largest, of a spring
};

/// How a substep of all forces is done.
struct Advance {
  Volumes volumes;
  Field<float> drift{};  // positions that are to move at its end, if nothing else acts before
};

/// The volumes V of the bodies of a batch in a substep. A = dV/dx.
struct LaneVolumes {
  float volume[lanes];    // m^3, at its start
  float rate[lanes];      // m^3/s, A . v
  float square[lanes];    // m^4, A . A
  float pressure[lanes];  // Pa, of the gas: that which the velocities v have felt already
};

/// The law of a force between two particles.
template <class F, class Real>
struct LengthLaw {
  struct type {};
};
template <HasElements F, class Real>
requires(F::coordinate == Coordinate::length) struct LengthLaw<F, Real> {
  using type = std::remove_cvref_t<decltype(std::declval<typename F::Data>().template elements<Real>()[0])>;
};
template <class F, class Real>
using LengthLawOf = typename LengthLaw<F, Real>::type;

/// What a force of a coordinate finds once from all particles: the poses of the shapes that offsets are from.
template <class F, class Real>
struct HeldOf {};
template <HasElements F, class Real>
requires(F::coordinate == Coordinate::offset) struct HeldOf<F, Real> : ShapePose<Real> {
};

namespace detail {
template <class Real, class... F>
std::tuple<HeldOf<F, Real>...> held_of(List<F...>);
}
using HeldForces = decltype(detail::held_of<double>(Forces{}));

}  // namespace softbody
