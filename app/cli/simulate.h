#pragma once
// `sbcollide simulate`: runs a scene without a window.

#include "app/cli/options.h"

namespace app::cli {

/// Prints the figures as a table, as one JSON document or as lines of JSON, and writes pictures, an animation and OBJ
/// files on request. Throws UsageError, SceneError, or what Capture throws. Calls OpenGL only if pictures are
/// requested.
void simulate(const Options& options);

}  // namespace app::cli
