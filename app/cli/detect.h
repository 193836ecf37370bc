#pragma once
// `sbcollide detect`: the contacts of any method in meshes of anyone's.

#include "app/cli/options.h"

namespace app {

/// Prints the figures as a table or as JSON, and writes the contacts if asked for. Throws UsageError or ObjError.
void detect(const Options& options);

}  // namespace app
