#pragma once
// The elements of the forces inside one body, in double: at(element, law) is called for each, of offsets
// at(element, place, law).

#include "softbody/mechanics/kernel_bodies.h"

namespace softbody {

/// Visits the forces of some coordinates in one body whose particles are at x.
template <Coordinate... coordinates, class At>
void visit_forces(const BodyModel& model, Field<const double> x, const At& at) {
  for_each_force(Forces{}, [&]<class F>(Name<F>) {
    if constexpr (((coordinate_of<F>() == coordinates) || ...))
      if (const auto* d = data<F>(model)) {
        HeldOf<F, double> held{};
        simd::hold<F, double, one_lane>(*d, x, 1, held);
        simd::visit<F, double>(model, *d, held, at);
      }
  });
}

/// Visits all forces in one body.
template <class At>
void visit_all(const BodyModel& model, Field<const double> x, const At& at) {
  visit_forces<Coordinate::length, Coordinate::volume, Coordinate::offset, Coordinate::path>(model, x, at);
}

}  // namespace softbody
