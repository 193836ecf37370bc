#pragma once

#include "softbody/integrate/integrators.h"

namespace app::report {

/// The largest step (s) with which a slightly disturbed ball in free flight keeps its energy for 300 steps.
struct StableStep {
  double stiffness = 0;  // N/m
  double found = 0;
  double predicted = 0;  // the integrator's own bound with its safety factor; infinite if it has none
};
inline constexpr double max_step_tried = 0.1;  // s

/// Returns the largest stable step, up to max_step_tried, to within 10 %. `stiffness`: N/m.
StableStep find_stable_step(const softbody::Integrator& integrator, double stiffness);

}  // namespace app::report
