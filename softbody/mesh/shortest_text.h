#pragma once

#include <array>
#include <charconv>
#include <string>

namespace softbody {

/// Returns the shortest text that stands for the number and reads back to the same bits.
inline std::string shortest_text(auto value) {
  std::array<char, 64> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

}  // namespace softbody
