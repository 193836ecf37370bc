#pragma once

#include <optional>

#include "softbody/world.h"

namespace app {

/// The one that chooses its steps itself: no report prescribes them.
inline bool chooses_steps(const softbody::Integrator& integrator) { return integrator.automatic; }

/// What a world is told: so many steps a frame, or none for one that chooses them.
inline std::optional<int> steps_for(const softbody::Integrator& integrator, int steps) {
  return chooses_steps(integrator) ? std::nullopt : std::optional(steps);
}

/// Figures are of whole frames: throws SceneError where the last one was simulated in part, see Dynamics::advance().
inline void require_whole_frame(const softbody::World& world) {
  if (world.profile().seconds < world.frame_time())
    throw softbody::SceneError("a frame would take more substeps than there may be");
}

}  // namespace app
