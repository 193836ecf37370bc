#pragma once
// Writes a scene as the text of a scene file, the inverse of load_scene().

#include <filesystem>
#include <string>

#include "softbody/scene/scene.h"

namespace softbody {

/// Returns the text of a scene file. If the file is put into `folder`, load_scene() reads it back to an equal scene.
/// Mesh files are named relative to `folder`; their contents are not written. The scene's key is the name of the file,
/// so it is not in the text. Throws SceneError if no scene file can hold the scene: it has no body and no dropper, two
/// materials have the same name, a text is not UTF-8, or the result is larger than max_toml_file_size.
std::string scene_toml(const Scene& scene, const std::filesystem::path& folder);

}  // namespace softbody
