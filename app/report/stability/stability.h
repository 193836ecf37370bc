#pragma once

#include "app/command/options.h"

namespace app {

/// `report stability`: extreme cases by integrator, length of a frame and stiffness, and what fails. Throws UsageError
/// and SceneError before anything runs.
void report_stability(const Options& options);

}  // namespace app
