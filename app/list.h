#pragma once
// `sbcollide list`: what there is to choose from.

#include <string>

namespace app {

/// Prints key, tab, name, a line each. what: "scenes", "methods" or "integrators".
void list(const std::string& what);

}  // namespace app
