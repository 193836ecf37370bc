#pragma once
// The commands that need no window; `report` has a folder of its own.

#include "app/cli/options.h"

namespace app::cli {

/// `list`: prints a line "KEY<tab>NAME" for each choice. what: see Options::list_of; of all lists, each comes behind a
/// line with its name. Throws SceneError if a scene file is invalid, after all others are printed.
void list(const std::string& what);

/// `new-method`: writes a detector to begin with, for `--guest`. Throws UsageError if there is a file of this name, or
/// if it is not to be one of C or C++.
void new_method(const std::filesystem::path& file);

/// `simulate`: runs a scene without a window. Prints the figures as a table, as one JSON document or as lines of JSON,
/// and writes pictures, an animation and OBJ files on request. Throws UsageError, SceneError, or what Capture throws.
/// Calls OpenGL only if pictures are requested.
void simulate(const Options& options);

/// `detect`: finds contacts in the user's own meshes, by any method. Prints the figures as a table or as JSON, and
/// writes the contacts on request. Throws UsageError or MeshFileError.
void detect(const Options& options);
/// `detect --continuous`, which detect() calls: finds all features of a mesh that meet on the way from one frame to the
/// next. Prints and throws alike, and writes the meetings on request.
void detect_continuous(const Options& options);

}  // namespace app::cli
