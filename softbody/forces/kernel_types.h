#pragma once
// Arguments of the kernels of forces. Arrays over lanes use only their first value for a body that is solved alone.

#include <tuple>

#include "softbody/forces/bound.h"
#include "softbody/forces/model_forces.h"

namespace softbody {

/// Bodies of one model in lanes, of which `used` lanes have a body, and the forces on them.
template <class Real>
struct LaneBodies {
  const BodyModel& model;
  int used;
  Field<const Real> x;  // m
  Field<Real> f;        // N
};

/// Dampers see no motion.
struct Still {};

/// Dampers see velocities.
struct Moving {
  Field<const float> v;  // m/s
};

/// Dampers see how far particles have gone since the start of an implicit step of h seconds. They act along the
/// directions that their coordinates had then, so that the damping has a potential. `frame`: what particles go without
/// leaving their places in a frame that moves with the body.
struct SinceStart {
  double inverse_h;  // 1/s
  Field<const double> x, frame;
};

/// XPBD's displacements d in a step of h seconds that started at x0.
struct Projection {
  float h;                  // s
  const float* moves;       // 0 or 1 for each lane
  Field<const float> x0;    // m
  Field<float> d, scratch;  // m; scratch: room for as much
};

namespace detail {
template <class F, class Real>
struct HeldOf {
  using type = Nothing;
};
template <class F, class Real>
requires requires { typename F::template Held<Real>; }
struct HeldOf<F, Real> {
  using type = typename F::template Held<Real>;
};
}  // namespace detail

/// What a force finds once from all particles of the bodies.
template <class F, class Real>
using HeldOf = typename detail::HeldOf<F, Real>::type;

namespace detail {
template <class Real, class... F>
std::tuple<typename HeldOf<F, Real>::type...> held_of(List<F...>);
}
/// What forces find once from all particles.
using HeldForces = decltype(detail::held_of<double>(Forces{}));

}  // namespace softbody
