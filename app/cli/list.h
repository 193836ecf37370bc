#pragma once
// `sbcollide list`: what there is to choose from.

#include <string>

namespace app {

/// Prints key, tab, name, a line each. what: "scenes", "methods" or "integrators". Throws SceneError if a scene is not
/// in order, once all others are printed.
void list(const std::string& what);

}  // namespace app
