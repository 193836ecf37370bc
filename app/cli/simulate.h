#pragma once
// `sbcollide simulate`: a scene without a window, its figures as a table or as JSON, pictures on request.

#include "app/cli/options.h"

namespace app {

/// Throws UsageError, SceneError, or what Capture throws. No GL is touched unless pictures are asked for.
void simulate(const Options& options);

}  // namespace app
