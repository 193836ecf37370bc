#pragma once
// `sbcollide detect --continuous`: finds all features of a mesh that meet on the way from one frame to the next.

#include "app/cli/options.h"

namespace app::cli {

/// Prints the figures as a table or as JSON, and writes the meetings on request. Throws UsageError or MeshFileError.
void detect_continuous(const Options& options);

}  // namespace app::cli
