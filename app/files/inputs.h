#pragma once
// Protects the files that the run reads: no output may replace one of them.

#include <filesystem>

#include "softbody/scene/scene.h"

namespace app::files {

/// Protects a file: from now on require_no_input() refuses it. Throws UsageError if standard output goes into the
/// file. Thread-safe.
void protect_input(const std::filesystem::path& file);
/// Protect the mesh file of a body; the mesh files of all bodies of a scene.
void protect_input(const softbody::MeshSource& mesh);
void protect_inputs(const softbody::Scene& scene);

/// Throws UsageError if `output` is a protected file, under any path or link. Thread-safe.
void require_no_input(const std::filesystem::path& output);

}  // namespace app::files
