#pragma once
// The files that the run reads: no output may replace one of them.

#include <filesystem>

#include "softbody/scene.h"

namespace app {

/// From now on require_no_input() refuses this file. Throws UsageError if standard output goes into it. Thread-safe.
void protect_input(const std::filesystem::path& file);
/// The same for the mesh files that a body, or all bodies of a scene, are made from.
void protect_input(const softbody::MeshSource& mesh);
void protect_inputs(const softbody::Scene& scene);

/// Throws UsageError if `output` is a protected file, by whatever path or link. Thread-safe.
void require_no_input(const std::filesystem::path& output);

}  // namespace app
