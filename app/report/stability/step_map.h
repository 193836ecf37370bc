#pragma once

#include "softbody/integrators.h"

namespace app {

/// s: the largest step with which a slightly disturbed ball in free flight keeps its energy for some hundred steps.
struct StableStep {
  double stiffness = 0;  // N/m
  double found = 0;
  double predicted = 0;  // the integrator's own bound, safety included; infinite for what has none
};
inline constexpr double max_step_tried = 0.1;  // s

StableStep find_stable_step(const softbody::Integrator& integrator, double stiffness);

}  // namespace app
