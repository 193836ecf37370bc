#pragma once
// `sbcollide list`: prints what can be chosen.

#include <string>

namespace app::cli {

/// Prints a line "KEY<tab>NAME" for each choice. what: see Options::list_of; of all lists, each comes behind a line
/// with its name. Throws SceneError if a scene file is invalid, after all others are printed.
void list(const std::string& what);

}  // namespace app::cli
