#pragma once
// The steps that a report prescribes to a world.

#include <optional>

#include "softbody/world.h"

namespace app {

/// Returns the steps per frame that a world is given; nothing for an integrator that chooses its own.
inline std::optional<int> steps_for(const softbody::Integrator& integrator, int steps) {
  return integrator.automatic ? std::nullopt : std::optional(steps);
}

/// Throws SceneError if only a part of the last frame was simulated (see Dynamics::advance()): figures are of whole
/// frames.
inline void require_whole_frame(const softbody::World& world) {
  if (world.profile().seconds < world.frame_time())
    throw softbody::SceneError("a frame would take more substeps than there may be");
}

}  // namespace app
