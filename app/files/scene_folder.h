#pragma once

#include <filesystem>

#include "engine/resources.h"

namespace app::files {

/// Returns the folder of the scenes that have a key. Throws engine::ResourceError if it is not found.
inline std::filesystem::path scene_folder() { return engine::find_folder("assets") / "scenes"; }

}  // namespace app::files
