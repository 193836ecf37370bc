#pragma once
// The elements of the forces inside bodies: at(coordinate, law) is called for each. `at` has the types Real, of a
// number, and V, of a number in each lane.

#include "softbody/forces/kernel_types.h"
#include "softbody/forces/shape_matching_kernel.h"

namespace softbody {

/// Finds what a force finds once from all particles, which are at x.
template <class F, class Real, int width>
SB_INLINE HeldOf<F, Real> hold(const typename F::Data& data, Field<const Real> x, int used) {
  HeldOf<F, Real> held{};
  if constexpr (requires { F::template hold<Real, width>(data, x, used, held); })
    F::template hold<Real, width>(data, x, used, held);
  return held;
}

template <class F, class Held, class At>
SB_INLINE void visit_elements(const typename F::Data& data, const Held& held, const At& at) {
  if constexpr (std::is_same_v<Held, Nothing>)
    F::visit(data, at);
  else
    F::visit(data, held, at);
}

/// Visits the forces of a coordinate in one body, in double.
template <Coordinate coordinate, class At>
void visit_all(const BodyModel& model, Field<const double> x, const At& at) {
  for_each_force(Forces{}, [&]<class F>(Name<F>) {
    if constexpr (HasElements<F>) {
      if constexpr (F::coordinate == coordinate)
        if (const auto* d = data<F>(model)) visit_elements<F>(*d, hold<F, double, one_lane>(*d, x, 1), at);
    }
  });
}

/// All forces that have elements, whatever their coordinate.
template <class At>
void visit_all(const BodyModel& model, Field<const double> x, const At& at) {
  for_each_force(Forces{}, [&]<class F>(Name<F>) {
    if constexpr (HasElements<F>)
      if (const auto* d = data<F>(model)) visit_elements<F>(*d, hold<F, double, one_lane>(*d, x, 1), at);
  });
}

}  // namespace softbody
