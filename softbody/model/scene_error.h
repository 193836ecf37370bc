#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>

namespace softbody {

/// Thrown for bad input. what() is one line: the file (and line, if there is one), what is wrong, what to do.
struct SceneError : std::runtime_error {
  /// Replaces control characters in the message, which may come from quoted names and keys, by question marks.
  explicit SceneError(std::string message) : std::runtime_error(without_controls(std::move(message))) {}

 private:
  static std::string without_controls(std::string message) {
    std::ranges::replace_if(
        message, [](unsigned char c) { return c < ' ' || c == 0x7f; }, '?');
    return message;
  }
};

}  // namespace softbody
