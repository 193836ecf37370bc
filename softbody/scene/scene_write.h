#pragma once
// The other way round than load_scene(): a scene as the text of a scene file.

#include <filesystem>
#include <string>

#include "softbody/scene/scene.h"

namespace softbody {

/// The text of a scene file that load_scene() reads back to an equal scene, if it lies in `folder`: mesh files are
/// named relative to that, and only named. The key is the file's name, so it is not in the text. Throws SceneError for
/// what no scene file can hold: no body and no dropper, two materials of one name, text that is not UTF-8, more than
/// max_toml_file_size.
std::string scene_toml(const Scene& scene, const std::filesystem::path& folder);

}  // namespace softbody
