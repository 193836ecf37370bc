#pragma once
// The steps that a report prescribes to a world.

#include <optional>
#include <string>
#include <string_view>

#include "softbody/world/world.h"

namespace app::report {

/// Returns the integrator with that number of steps per frame. It chooses its own if it is `auto`, or `steps` is 0.
inline softbody::IntegratorChoice with_steps(const softbody::Integrator& integrator, int steps) {
  return {std::string(integrator.key), integrator.automatic || steps == 0 ? std::nullopt : std::optional(steps)};
}

/// Returns the integrator with one step per frame, with which no scene is refused.
inline softbody::IntegratorChoice one_step(std::string_view key = softbody::default_integrator) {
  return {std::string(key), 1};
}

/// Throws SceneError if only a part of the last frame was simulated (see StepReport): figures are of whole
/// frames.
inline void require_whole_frame(const softbody::World& world) {
  if (world.last_step().seconds < world.frame_time())
    throw softbody::SceneError("a frame would take more work than there may be");
}

}  // namespace app::report
