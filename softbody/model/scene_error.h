#pragma once

#include <stdexcept>
#include <string>

namespace softbody {

/// Thrown for bad input. what() is one line: the file (and line, if there is one), what is wrong, what to do.
struct SceneError : std::runtime_error {
  /// Replaces control characters in the message, which may come from quoted names and keys, by question marks.
  explicit SceneError(std::string message);
};

}  // namespace softbody
