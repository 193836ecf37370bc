#pragma once

#include <stdexcept>
#include <string>

namespace softbody {

/// Bad input. what() is one line: the file (and line, where there is one), what is wrong, what to do.
struct SceneError : std::runtime_error {
  /// One line, whatever names and keys it quotes: control characters become question marks.
  explicit SceneError(std::string message);
};

}  // namespace softbody
