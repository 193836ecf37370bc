#pragma once
// `report`: measurements that take minutes and leave files behind.

#include "app/command/options.h"

namespace app {

/// Makes the report that the options name, in the folder options.out. Throws UsageError before anything runs if there
/// is no such report or the folder cannot be written to; and SceneError.
void report(const Options& options);

}  // namespace app
