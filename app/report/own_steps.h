#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "softbody/world.h"

namespace app {

/// The one that chooses its steps itself: no report prescribes them.
inline bool chooses_steps(const softbody::Integrator& integrator) { return integrator.automatic; }

/// The integrator with so many steps a frame, unless it chooses them itself.
inline softbody::IntegratorChoice with_steps(const softbody::Integrator& integrator, int steps) {
  return {std::string(integrator.key), chooses_steps(integrator) ? std::nullopt : std::optional(steps)};
}

/// The integrator with one step a frame, whatever becomes of it: no scene is refused.
inline softbody::IntegratorChoice one_step(std::string_view key = softbody::default_integrator) {
  softbody::IntegratorChoice choice;
  choice.key = key;
  choice.substeps = 1;
  return choice;
}

/// Figures are of whole frames: throws SceneError where the last one was simulated in part, see StepReport.
inline void require_whole_frame(const softbody::World& world) {
  if (world.last_step().seconds < world.frame_time())
    throw softbody::SceneError("a frame would take more substeps than there may be");
}

}  // namespace app
