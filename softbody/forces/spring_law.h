// Hooke's law of springs. Compiled for each of Highway's targets, see state/simd.h.
#if defined(SOFTBODY_FORCES_SPRING_LAW_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOFTBODY_FORCES_SPRING_LAW_H
#undef SOFTBODY_FORCES_SPRING_LAW_H
#else
#define SOFTBODY_FORCES_SPRING_LAW_H
#endif

#include <hwy/highway.h>

#include "softbody/forces/springs.h"

HWY_BEFORE_NAMESPACE();
namespace softbody {
namespace HWY_NAMESPACE {

/// Returns the force (N) with which a spring pulls its ends together. T: a number, a Jet or one number for each lane.
template <class Real, class T>
HWY_INLINE T pull_at(const SpringOf<Real>& spring, T length) {
  return spring.stiffness * (length - spring.rest);
}

/// Returns the energy in J that a spring holds.
template <class Real, class T>
HWY_INLINE T stored_at(const SpringOf<Real>& spring, T length) {
  return spring.stiffness / 2 * (length - spring.rest) * (length - spring.rest);
}

}  // namespace HWY_NAMESPACE
}  // namespace softbody
HWY_AFTER_NAMESPACE();

#endif  // include guard
