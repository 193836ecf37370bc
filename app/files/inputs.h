#pragma once
// The files that the run reads: where the scenes are, and what no output may replace.

#include <filesystem>

#include "engine/resources.h"
#include "softbody/scene/scene.h"

namespace app::files {

/// Returns the folder of the scenes that have a key. Throws engine::ResourceError if it is not found.
inline std::filesystem::path scene_folder() { return engine::find_folder("assets") / "scenes"; }

/// Protects a file: from now on require_no_input() refuses it. Throws UsageError if standard output goes into the
/// file. Thread-safe.
void protect_input(const std::filesystem::path& file);
/// Protect the mesh file of a body; the mesh files of all bodies of a scene.
void protect_input(const softbody::MeshSource& mesh);
void protect_inputs(const softbody::Scene& scene);

/// Throws UsageError if `output` is a protected file, under any path or link. Thread-safe.
void require_no_input(const std::filesystem::path& output);

}  // namespace app::files
