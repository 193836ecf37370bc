#pragma once

#include <optional>

#include "softbody/integrators.h"

namespace app {

/// The one that chooses its steps itself: no report prescribes them.
inline bool chooses_steps(const softbody::Integrator& integrator) { return integrator.automatic; }

/// What a world is told: so many steps a frame, or none for one that chooses them.
inline std::optional<int> steps_for(const softbody::Integrator& integrator, int steps) {
  return chooses_steps(integrator) ? std::nullopt : std::optional(steps);
}

}  // namespace app
