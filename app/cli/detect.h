#pragma once
// `sbcollide detect`: finds contacts in the user's own meshes, by any method.

#include "app/cli/options.h"

namespace app::cli {

/// Prints the figures as a table or as JSON, and writes the contacts on request. Throws UsageError or MeshFileError.
void detect(const Options& options);

}  // namespace app::cli
